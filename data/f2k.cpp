#include "data/f2k.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/event_files.h"
#include "data/event_rules.h"

namespace floe {

namespace {

constexpr std::string_view track_layout = "TR gen igen NAME x y z zenith azimuth length energy time";

// Lines that describe hits or waveforms (HT, WF) are left out: to pass over them would lose data.
constexpr std::array<std::string_view, 21> keywords = {
    "V",       "HI",   "ARRAY",  "OM",      "PAR", "TBEGIN",   "TEND",     "EM",       "EE", "TR", "FIT",
    "FRESULT", "TRIG", "STATUS", "FIT_DEF", "US",  "STAT_DEF", "TRIG_DEF", "USER_DEF", "ES", "END"};

double within_turn(double azimuth_deg) {
  const double rest = std::fmod(azimuth_deg, 360.0);
  return rest < 0 ? rest + 360.0 : rest;
}

void expect_tracks(const Event& event, const Location& where) {
  if (event.truth.empty())
    throw InputError(where, "an event without a particle",
                     fmt::format("at least one line '{}'", track_layout));
}

}  // namespace

bool is_f2k_keyword(std::string_view word) {
  return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

Particle parse_track(const TextLine& line) {
  expect_fields(line, 12, 12, track_layout);
  parse_integer(line, 1, "generation");
  parse_integer(line, 2, "number of the particle");
  Particle particle;
  particle.name = line.fields[3];
  particle.position = {parse_number(line, 4, "x [m]"), parse_number(line, 5, "y [m]"),
                       parse_number(line, 6, "z [m]")};
  const double zenith = parse_number(line, 7, "zenith [deg]");
  expect_range(line, zenith, 0, 180, "zenith [deg]");
  particle.zenith = zenith * degree;
  particle.azimuth = within_turn(parse_number(line, 8, "azimuth [deg]")) * degree;
  particle.length = parse_number(line, 9, "length [m]");
  particle.energy = parse_number(line, 10, "energy [GeV]");
  particle.time = parse_number(line, 11, "time [ns]");
  if (const auto problem = problem_of(particle))
    throw InputError(line.where, problem->found, problem->expected);
  return particle;
}

std::vector<Event> read_f2k(const std::filesystem::path& path) {
  std::vector<Event> events;
  Location begin{path.string()};  // of the event read last
  for_each_text_line(path, [&](const TextLine& line) {
    const std::string& keyword = line.fields[0];
    if (keyword == "EM" || (keyword == "TR" && events.empty())) {
      if (!events.empty()) expect_tracks(events.back(), begin);
      events.emplace_back();
      begin = line.where;
    }
    if (keyword == "TR")
      events.back().truth.push_back(parse_track(line));
    else if (!is_f2k_keyword(keyword) && keyword != "HIT")
      throw InputError(line.where, in_quotes(line.text),
                       fmt::format("'{}' or another line of f2k", track_layout));
  });
  if (events.empty())
    throw InputError(begin, "no particle", fmt::format("at least one line '{}'", track_layout));
  expect_tracks(events.back(), begin);
  const std::string name = event_name_of(path);
  for (std::size_t i = 0; i < events.size(); ++i)
    events[i].id = events.size() == 1 ? name : fmt::format("{}-{}", name, i + 1);
  return events;
}

}  // namespace floe

#include "data/text_events.h"

#include <fmt/format.h>

#include <utility>

#include "data/base/text.h"
#include "data/event_rules.h"
#include "data/f2k.h"

namespace floe {

namespace {

constexpr std::string_view hit_layout = "HIT string DOM time[ns] wavelength[nm] p_theta p_phi d_theta d_phi";
constexpr std::string_view charge_layout = "string DOM time[ns] charge[pe]";

constexpr long clipped(long value) {
  constexpr long beyond = 1'000'000;  // out of every range, and safe to narrow
  return value < -beyond ? -beyond : value > beyond ? beyond : value;
}

int parse_string(const TextLine& line, std::size_t field) {
  return static_cast<int>(clipped(parse_integer(line, field, "string")));
}

int parse_dom(const TextLine& line, std::size_t field) {
  const std::string& text = line.fields.at(field);
  const auto separator = text.find('_');
  if (separator == text.npos) return static_cast<int>(clipped(parse_integer(line, field, "DOM")));
  const TextLine parts{line.where, line.text, {text.substr(0, separator), text.substr(separator + 1)}};
  parse_integer(parts, 1, "PMT of DOM_PMT");
  return static_cast<int>(clipped(parse_integer(parts, 0, "DOM of DOM_PMT")));
}

Vec3f parse_direction(const TextLine& line, std::size_t field, std::string_view theta_name,
                      std::string_view phi_name) {
  // Angles rounded to 1 mrad may lie this much beyond their range; degrees lie far beyond.
  constexpr double rounding = 1e-3;
  const double theta = parse_number(line, field, theta_name);
  const double phi = parse_number(line, field + 1, phi_name);
  expect_range(line, theta, 0, pi + rounding, theta_name);
  expect_range(line, phi, -2 * pi - rounding, 2 * pi + rounding, phi_name);
  return unit_vector(theta, phi).cast<float>();
}

Hit parse_hit(const TextLine& line) {
  expect_fields(line, 9, 9, hit_layout);
  Hit hit;
  hit.module = {parse_string(line, 1), parse_dom(line, 2)};
  hit.time = parse_number(line, 3, "time [ns]");
  hit.wavelength = static_cast<float>(parse_number(line, 4, "wavelength [nm]"));
  hit.direction = parse_direction(line, 5, "p_theta [rad]", "p_phi [rad]");
  hit.inward = parse_direction(line, 7, "d_theta [rad]", "d_phi [rad]");
  return hit;
}

Hit parse_charge(const TextLine& line) {
  expect_fields(line, 4, 4, charge_layout);
  Hit hit;
  hit.module = {parse_string(line, 0), parse_dom(line, 1)};
  hit.time = parse_number(line, 2, "time [ns]");
  hit.charge = static_cast<float>(parse_number(line, 3, "charge [pe]"));
  return hit;
}

void add_hit(Event& event, const Hit& hit, const TextLine& line) {
  if (const auto problem = problem_of(hit)) throw InputError(line.where, problem->found, problem->expected);
  event.hits.push_back(hit);
}

void expect_hits(const Event& event, const std::filesystem::path& path, std::string_view layout) {
  if (event.hits.empty())
    throw InputError({path.string()}, "no hits at all", fmt::format("at least one line '{}'", layout));
}

[[noreturn]] void throw_not_a_hit(const TextLine& line) {
  if (line.fields[0] == "FLASHER")
    throw InputError(line.where, in_quotes(line.text), fmt::format("'{}'", hit_layout),
                     "Sets of flasher runs are not readable as events yet: give the hits of one run, without "
                     "its FLASHER line");
  throw InputError(line.where, in_quotes(line.text), fmt::format("'{}' or a line of f2k", hit_layout),
                   "A list of charges ('string DOM time charge') is read from a file named .dat");
}

}  // namespace

Event read_hit_text(const std::filesystem::path& path) {
  Event event;
  event.id = event_name_of(path);
  bool begun = false;
  for_each_text_line(path, [&](const TextLine& line) {
    const std::string& keyword = line.fields[0];
    if (keyword == "HIT") return add_hit(event, parse_hit(line), line);
    if (keyword == "TR") return event.truth.push_back(parse_track(line));
    if (!is_f2k_keyword(keyword)) throw_not_a_hit(line);
    if (keyword == "EM" && std::exchange(begun, true))
      throw InputError(line.where, "a second EM line", "the hits of one event",
                       "Split the file at its EM lines");
  });
  expect_hits(event, path, hit_layout);
  return event;
}

Event read_charge_list(const std::filesystem::path& path) {
  Event event;
  event.id = event_name_of(path);
  for_each_text_line(path, [&](const TextLine& line) { add_hit(event, parse_charge(line), line); });
  expect_hits(event, path, charge_layout);
  return event;
}

}  // namespace floe

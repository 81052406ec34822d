#include "data/text_events.h"

#include <fmt/format.h>

#include <utility>

#include "data/base/text.h"
#include "data/event_rules.h"
#include "data/f2k.h"
#include "data/hit_lines.h"

namespace floe {

namespace {

void expect_hits(const Event& event, const std::filesystem::path& path, std::string_view layout) {
  if (event.hits.empty())
    throw InputError({path.string()}, "no hits at all", fmt::format("at least one line '{}'", layout));
}

[[noreturn]] void throw_flasher_set(const TextLine& line, std::string_view layout) {
  throw InputError(line.where, in_quotes(line.text), fmt::format("'{}'", layout),
                   "This is a set of flasher runs: floe import --flashers makes an event file of it");
}

[[noreturn]] void throw_not_a_hit(const TextLine& line) {
  if (line.fields[0] == "FLASHER") throw_flasher_set(line, hit_layout);
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
    if (keyword == "HIT") return event.hits.push_back(parse_hit_line(line));
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
  for_each_text_line(path, [&](const TextLine& line) {
    if (line.fields[0] == "FLASHER") throw_flasher_set(line, charge_layout);
    event.hits.push_back(parse_charge_line(line));
  });
  expect_hits(event, path, charge_layout);
  return event;
}

}  // namespace floe

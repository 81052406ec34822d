#include "data/flasher_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "data/base/text.h"
#include "data/event_rules.h"
#include "data/hit_lines.h"

namespace floe {

namespace {

constexpr std::string_view flasher_layout = "FLASHER string DOM key=value ...";

// A key of the line, and what its value is to the event; the pattern of LEDs is the one that is no number.
struct NumberKey {
  std::string_view name;
  void (*set)(Event& event, double value);
  double (*get)(const Event& event);  // NaN when unknown
};
constexpr NumberKey number_keys[] = {
    {"orientation_deg", [](Event& e, double value) { e.flasher->orientation = value * degree; },
     [](const Event& e) { return e.flasher->orientation / degree; }},
    {"wavelength_nm", [](Event& e, double value) { e.flasher->wavelength = value; },
     [](const Event& e) { return e.flasher->wavelength; }},
    {"width_deg", [](Event& e, double value) { e.flasher->beam_width = value * degree; },
     [](const Event& e) { return e.flasher->beam_width / degree; }},
    {"pulse_width_ns", [](Event& e, double value) { e.flasher->pulse_width = value; },
     [](const Event& e) { return e.flasher->pulse_width; }},
    {"photons", [](Event& e, double value) { e.flasher->photons = value; },
     [](const Event& e) { return e.flasher->photons; }},
    {"repeats", [](Event& e, double value) { e.repeats = value; }, [](const Event& e) { return e.repeats; }},
    {"oversize", [](Event& e, double value) { e.flasher->oversize = value; },
     [](const Event& e) { return e.flasher->oversize; }},
};

std::string known_keys() {
  std::string names = "leds";
  for (const NumberKey& key : number_keys) names += fmt::format(", {}", key.name);
  return names;
}

// The line with only the value left in one of its fields, so that an error can name the field.
TextLine with_value(const TextLine& line, std::size_t field, std::string_view value) {
  TextLine result = line;
  result.fields[field] = value;
  return result;
}

void read_leds(const TextLine& line, std::string_view name, Event& event) {
  const auto leds = led_pattern_of(name);
  if (!leds) throw InputError(line.where, "leds=" + in_quotes(name), known_led_patterns);
  event.flasher->leds = *leds;
}

// Reads field "key=value" into the event; returns the key.
std::string_view read_key(const TextLine& line, std::size_t field, Event& event) {
  const std::string_view text = line.fields[field];
  const auto equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const std::string_view value = equals == text.npos ? "" : text.substr(equals + 1);
  const auto key = std::find_if(std::begin(number_keys), std::end(number_keys),
                                [&](const NumberKey& k) { return k.name == name; });
  if (equals == text.npos || (name != "leds" && key == std::end(number_keys)))
    throw InputError(line.where, in_quotes(text),
                     fmt::format("key=value with one of the keys {}", known_keys()));
  if (name == "leds")
    read_leds(line, value, event);
  else
    key->set(event, parse_number(with_value(line, field, value), field, name));
  return name;
}

Event parse_flasher_line(const TextLine& line, FlasherRunNames& names) {
  constexpr std::size_t keys_begin = 3, most_keys = std::size(number_keys) + 1;
  expect_fields(line, keys_begin, keys_begin + most_keys, flasher_layout);
  Event event;
  event.flasher = FlasherRun{};
  event.flasher->module = parse_module(line, 1);
  std::vector<std::string_view> known;
  for (std::size_t field = keys_begin; field < line.fields.size(); ++field) {
    const std::string_view key = read_key(line, field, event);
    if (std::find(known.begin(), known.end(), key) != known.end())
      throw InputError(line.where, fmt::format("{} again", in_quotes(line.fields[field])), "each key once");
    known.push_back(key);
  }
  expect_range(line, event.repeats, 1, 1e9, "repeats");
  if (const auto problem = problem_of(*event.flasher))
    throw InputError(line.where, problem->found, problem->expected);
  event.id = names.next(event.flasher->module);
  return event;
}

Hit parse_photon(const TextLine& line, const Event& event) {
  if (line.fields[0] != "HIT")
    throw InputError(line.where, in_quotes(line.text),
                     fmt::format("'{}' or '{}'", hit_layout, flasher_layout),
                     "Lists of charges ('string DOM time charge') are read from a file named .dat");
  Hit hit = parse_hit_line(line);
  hit.charge = static_cast<float>(1 / event.repeats);
  return hit;
}

Hit parse_average(const TextLine& line, const Event&) {
  return parse_charge_line(line);
}

using ParseHit = Hit (*)(const TextLine&, const Event&);
ParseHit parser_for(const std::filesystem::path& path) {
  const std::string suffix = text_suffix_of(path);
  if (suffix == ".hits" || suffix == ".txt") return parse_photon;
  if (suffix == ".dat") return parse_average;
  throw InputError(
      {path.string()}, fmt::format("the suffix '{}'", suffix),
      "a set of flasher runs: .hits or .txt (photons) or .dat (averaged charges), each also with .gz");
}

}  // namespace

void for_each_flasher_run(const std::filesystem::path& path, const std::function<void(const Event&)>& use) {
  expect_readable_file(path);
  const ParseHit parse_hit = parser_for(path);
  FlasherRunNames names;
  std::optional<Event> run;
  for_each_text_line(path, [&](const TextLine& line) {
    if (line.fields[0] == "FLASHER") {
      if (run) use(*run);
      run = parse_flasher_line(line, names);
    } else if (!run) {
      throw InputError(line.where, in_quotes(line.text), fmt::format("'{}' before any hit", flasher_layout),
                       "Hits that are no set of flasher runs are imported without --flashers");
    } else {
      run->hits.push_back(parse_hit(line, *run));
    }
  });
  if (!run)
    throw InputError({path.string()}, "no flasher run",
                     fmt::format("at least one line '{}'", flasher_layout));
  use(*run);
}

std::string flasher_line(const Event& event) {
  const FlasherRun& run = event.flasher.value();
  std::string line =
      fmt::format("FLASHER {} {} leds={}", run.module.string, run.module.dom, name_of(run.leds));
  for (const NumberKey& key : number_keys)
    if (const double value = key.get(event); !std::isnan(value))
      line += fmt::format(" {}={:.12g}", key.name, value);
  return line + '\n';
}

}  // namespace floe

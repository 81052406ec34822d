#include "apps/flasher_runs_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "data/base/text.h"
#include "data/base/toml_text.h"
#include "data/base/words.h"
#include "data/event_rules.h"

namespace floe {

namespace {

// A key of a table with its value, and where they stand.
struct Entry {
  std::string file, key;
  const toml::value* value;

  Location where() const { return place_of(file, *value); }
  [[noreturn]] void refuse(std::string_view expected) const {
    throw InputError(where(), quoted_line(*value), fmt::format("{} for {}", expected, key));
  }
  double number() const {
    if (value->is_integer()) return static_cast<double>(value->as_integer());
    if (!value->is_floating() || !std::isfinite(value->as_floating())) refuse("a number");
    return value->as_floating();
  }
  int whole(int low, int high) const {
    if (!value->is_integer() || value->as_integer() < low || value->as_integer() > high)
      refuse(fmt::format("a whole number from {} to {}", low, high));
    return static_cast<int>(value->as_integer());
  }
};

// The entries of a table in the order of their lines.
std::vector<Entry> entries_of(const std::string& file, const toml::value& table) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table.as_table()) entries.push_back({file, key, &value});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.where().line, a.key) < std::pair(b.where().line, b.key);
  });
  return entries;
}

void read_module(const Entry& entry, RunToSimulate& run) {
  constexpr const char* layout = "[STRING, DOM], e.g. [63, 20],";
  if (!entry.value->is_array() || entry.value->as_array().size() != 2) entry.refuse(layout);
  const auto number = [&](std::size_t i) {
    return Entry{entry.file, entry.key, &entry.value->as_array()[i]};
  };
  run.run.module = {number(0).whole(1, largest_string), number(1).whole(1, largest_dom)};
}

void read_leds(const Entry& entry, RunToSimulate& run) {
  std::string name;
  if (entry.value->is_string()) name = entry.value->as_string().str;
  if (entry.value->is_integer()) name = std::to_string(entry.value->as_integer());
  const auto leds = led_pattern_of(name);
  if (!leds) entry.refuse(known_led_patterns);
  run.run.leds = *leds;
}

void read_wavelength(const Entry& entry, RunToSimulate& run) {
  run.run.wavelength = entry.number();
  run.whole_line = true;
}

// The file that an entry names; relative names start at the folder of the TOML file.
std::filesystem::path file_of(const Entry& entry) {
  if (!entry.value->is_string()) entry.refuse("the name of a file");
  return std::filesystem::path(entry.file).parent_path() / entry.value->as_string().str;
}

void read_beam(const Entry& entry, RunToSimulate& run) {
  run.beam = read_beam_profile(file_of(entry));
  run.run.beam_width = equivalent_beam_width(*run.beam);
}

void read_pulse(const Entry& entry, RunToSimulate& run) {
  run.pulse = read_pulse_shape(file_of(entry));
  run.run.pulse_width = equivalent_pulse_width(*run.pulse);
}

void read_beam_width(const Entry& entry, RunToSimulate& run) {
  run.run.beam_width = entry.number() * degree;
  run.beam.reset();  // that of the defaults
}

void read_pulse_width(const Entry& entry, RunToSimulate& run) {
  run.run.pulse_width = entry.number();
  run.pulse.reset();
}

struct Key {
  const char* name;
  void (*read)(const Entry& entry, RunToSimulate& run);
};
constexpr Key place_keys[] = {
    {"module", read_module},
    {"string", [](const Entry& e, RunToSimulate& r) { r.run.module.string = e.whole(1, largest_string); }},
    {"dom", [](const Entry& e, RunToSimulate& r) { r.run.module.dom = e.whole(1, largest_dom); }},
};
constexpr Key light_keys[] = {
    {"leds", read_leds},
    {"orientation_deg", [](const Entry& e, RunToSimulate& r) { r.run.orientation = e.number() * degree; }},
    {"wavelength_nm", read_wavelength},
    {"width_deg", read_beam_width},
    {"pulse_width_ns", read_pulse_width},
    {"beam", read_beam},
    {"pulse", read_pulse},
    {"photons", [](const Entry& e, RunToSimulate& r) { r.run.photons = e.number(); }},
    {"repeats", [](const Entry& e, RunToSimulate& r) { r.repeats = e.whole(1, 1'000'000); }},
};

using Keys = std::vector<Key>;

[[noreturn]] void throw_unknown_key(const Entry& entry, const std::vector<std::string>& known) {
  const std::string meant = nearest_word(entry.key, known);
  throw InputError(entry.where(), fmt::format("an unknown key {}", in_quotes(entry.key)),
                   fmt::format("one of {}", fmt::join(known, ", ")),
                   meant.empty() ? "" : fmt::format("Did you mean {}?", meant));
}

// A beam and a pulse are said once in a table: as a width, or as what was measured.
void expect_said_once(const std::vector<Entry>& entries) {
  for (const auto& [width, measured] :
       {std::pair("width_deg", "beam"), std::pair("pulse_width_ns", "pulse")}) {
    const auto has = [&](const char* key) {
      return std::any_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    };
    for (const Entry& entry : entries)
      if (entry.key == measured && has(width))
        throw InputError(entry.where(), fmt::format("{} beside {}", measured, width), "one of the two");
  }
}

// Reads a table into the run; each value is checked where it stands.
void read_table(const std::string& file, const toml::value& table, const Keys& keys, RunToSimulate& run) {
  const std::vector<Entry> entries = entries_of(file, table);
  expect_said_once(entries);
  for (const Entry& entry : entries) {
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == entry.key; });
    if (key == keys.end()) {
      std::vector<std::string> known;
      for (const Key& k : keys) known.emplace_back(k.name);
      throw_unknown_key(entry, known);
    }
    key->read(entry, run);
    if (const auto problem = problem_of(run.run))
      throw InputError(entry.where(), problem->found, problem->expected);
  }
}

// A run names its module in one of two ways, and someone must say how bright it is.
void expect_complete(const Entry& table, const RunToSimulate& run) {
  const auto& named = table.value->as_table();
  const bool module = named.contains("module"), string = named.contains("string"),
             dom = named.contains("dom");
  if (module ? string || dom : !string || !dom)
    throw InputError(table.where(), "a run that does not name its module once",
                     "module = [STRING, DOM], or string and dom");
  if (std::isnan(run.run.photons))
    throw InputError(table.where(), "a run without photons", "photons in the run or in [defaults]");
}

RunToSimulate read_run(const Entry& table, const RunToSimulate& defaults) {
  if (!table.value->is_table()) table.refuse("a table [[run]]");
  Keys keys(std::begin(place_keys), std::end(place_keys));
  keys.insert(keys.end(), std::begin(light_keys), std::end(light_keys));
  RunToSimulate run = defaults;
  read_table(table.file, *table.value, keys, run);
  expect_complete(table, run);
  return run;
}

}  // namespace

std::vector<RunToSimulate> read_flasher_runs(const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::value content = read_toml(file, "Its format is in docs/formats.md");
  RunToSimulate defaults;
  defaults.run.module = {1, 1};  // until a run names its own
  defaults.run.orientation = 0;
  std::vector<RunToSimulate> runs;
  const std::vector<Entry> tables = entries_of(file, content);
  for (const Entry& table : tables) {
    if (table.key == "run") continue;
    if (table.key != "defaults") throw_unknown_key(table, {"run", "defaults"});
    if (!table.value->is_table()) table.refuse("a table");
    read_table(file, *table.value, {std::begin(light_keys), std::end(light_keys)}, defaults);
  }
  for (const Entry& table : tables) {
    if (table.key != "run") continue;
    if (!table.value->is_array()) table.refuse("tables [[run]]");
    for (const toml::value& run : table.value->as_array())
      runs.push_back(read_run({file, table.key, &run}, defaults));
  }
  if (runs.empty()) throw InputError({file}, "no run", "at least one table [[run]]");
  return runs;
}

}  // namespace floe

#include "response/response_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "data/base/text.h"
#include "data/base/toml_text.h"
#include "data/base/words.h"

namespace floe {

namespace {

[[noreturn]] void refuse_name(const std::string& file, const toml::value& value, const std::string& kind,
                              const std::string& name, std::vector<std::string> known) {
  known.erase(std::unique(known.begin(), known.end()), known.end());
  const std::string meant = nearest_word(name, known);
  throw InputError(place_of(file, value), fmt::format("an unknown {} {}", kind, in_quotes(name)),
                   fmt::format("one of {}", fmt::join(known, ", ")),
                   meant.empty() ? "" : fmt::format("Did you mean {}?", meant));
}

double number_of(const std::string& file, const ResponseSetting& setting, const toml::value& value) {
  const bool whole = value.is_integer();
  const double number = whole                 ? static_cast<double>(value.as_integer())
                        : value.is_floating() ? value.as_floating()
                                              : std::nan("");
  const bool wants_whole = std::holds_alternative<int*>(setting.value);
  if (!(number >= setting.low && number <= setting.high) || (wants_whole && !whole))
    throw InputError(place_of(file, value), quoted_line(value),
                     fmt::format("a {} from {:g} to {:g} for {}", wants_whole ? "whole number" : "number",
                                 setting.low, setting.high, setting.key));
  return number;
}

CoincidenceMode mode_of(const std::string& file, const toml::value& value) {
  for (const auto mode : {CoincidenceMode::soft, CoincidenceMode::hard, CoincidenceMode::none})
    if (value.is_string() && value.as_string().str == name_of(mode)) return mode;
  throw InputError(place_of(file, value), quoted_line(value), "\"soft\", \"hard\" or \"none\" for mode");
}

void set(const std::string& file, const ResponseSetting& setting, const toml::value& value) {
  if (auto* const* number = std::get_if<double*>(&setting.value))
    **number = number_of(file, setting, value);
  else if (auto* const* whole = std::get_if<int*>(&setting.value))
    **whole = static_cast<int>(number_of(file, setting, value));
  else
    *std::get<CoincidenceMode*>(setting.value) = mode_of(file, value);
}

std::string value_text(const ResponseSetting& setting) {
  if (const auto* number = std::get_if<double*>(&setting.value)) {
    const std::string text = fmt::format("{}", **number);
    return text.find_first_of(".e") == text.npos ? text + ".0" : text;
  }
  if (const auto* whole = std::get_if<int*>(&setting.value)) return fmt::format("{}", **whole);
  return fmt::format("\"{}\"", name_of(*std::get<CoincidenceMode*>(setting.value)));
}

}  // namespace

ResponseSettings read_response_file(const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::value content =
      read_toml(file, "Its keys are in docs/formats.md; floe respond --write-response FILE.toml writes one");
  ResponseSettings settings;
  const std::vector<ResponseSetting> list = list_of(settings);
  for (const auto& [section, table] : content.as_table()) {
    std::vector<std::string> sections, keys;
    for (const ResponseSetting& setting : list) {
      sections.emplace_back(setting.section);
      if (setting.section == section) keys.emplace_back(setting.key);
    }
    if (keys.empty()) refuse_name(file, table, "section", section, sections);
    if (!table.is_table())
      throw InputError(place_of(file, table), quoted_line(table), fmt::format("a section [{}]", section));
    for (const auto& [key, value] : table.as_table()) {
      const auto setting = std::find_if(list.begin(), list.end(), [&](const ResponseSetting& one) {
        return one.section == section && one.key == key;
      });
      if (setting == list.end()) refuse_name(file, value, "key", key, keys);
      set(file, *setting, value);
    }
  }
  try {
    check(settings);
  } catch (const UsageError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
  return settings;
}

std::string response_file_text(const ResponseSettings& settings) {
  ResponseSettings copy = settings;
  std::string text =
      "# The electronics of the modules: what floe respond does to photons. What is not named keeps its "
      "default.\n";
  std::string section;
  for (const ResponseSetting& setting : list_of(copy)) {
    if (setting.section != section) {
      section = setting.section;
      text += fmt::format("\n[{}]\n", section);
    }
    text += fmt::format("# {} ({})\n{} = {}\n", setting.meaning, setting.source, setting.key,
                        value_text(setting));
  }
  return text;
}

}  // namespace floe

#include "propagation/effects_file.h"

#include <fmt/format.h>

#include <toml.hpp>

#include "data/base/error.h"
#include "data/base/text.h"

namespace floe {

namespace {

constexpr const char* key = "effects";
constexpr const char* expected = "effects = [[\"EFFECT.PARAMETER=VALUE\", ...], ...]";

[[noreturn]] void refuse(const std::string& file, const std::string& found) {
  throw InputError({file}, found, expected, "Mend the line, or remove the file");
}

toml::value parsed(const std::string& file) {
  std::istringstream text(read_whole_file(file));
  try {
    return toml::parse(text, file);
  } catch (const toml::exception& error) {
    refuse(file, fmt::format("no TOML ({})", std::string(error.what()).substr(0, 80)));
  }
}

}  // namespace

EffectGroups read_effects_file(const std::filesystem::path& directory) {
  const std::string file = (directory / effects_file).string();
  if (!std::filesystem::exists(file)) return {};
  const toml::value content = parsed(file);
  EffectGroups groups;
  for (const auto& [name, value] : content.as_table()) {
    if (name != key) refuse(file, fmt::format("unknown key \"{}\"", name));
    if (!value.is_array()) refuse(file, "effects that are no list");
    for (const toml::value& group : value.as_array()) {
      if (!group.is_array()) refuse(file, "an effect that is no list of settings");
      groups.emplace_back();
      for (const toml::value& setting : group.as_array()) {
        if (!setting.is_string()) refuse(file, "a setting that is no text");
        groups.back().push_back(parse_effect_setting(setting.as_string().str));
        find_effect(groups.back().back().effect);
      }
    }
  }
  return groups;
}

std::string effects_file_text(const EffectGroups& groups) {
  std::string text =
      "# Effects that the other files of this directory cannot hold. Read by floe alone.\neffects = [\n";
  for (const auto& group : groups) {
    text += "  [";
    for (std::size_t i = 0; i < group.size(); ++i)
      text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", text_of(group[i]));
    text += "],\n";
  }
  return text + "]\n";
}

}  // namespace floe

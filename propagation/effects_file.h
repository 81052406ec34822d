// floe.toml in an ice directory: effects that none of the directory's own files can hold (of modules, of
// flashers). floe applies them, the field's other tools ignore the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "propagation/effects/effect.h"

namespace floe {

inline constexpr std::string_view effects_file = "floe.toml";

// Settings that belong together (an effect's place and values), in the order in which they are applied.
using EffectGroups = std::vector<std::vector<EffectSetting>>;

// From the directory; empty where it has no such file. Throws InputError (not readable, not TOML), UsageError
// (unknown keys, effects, parameters).
EffectGroups read_effects_file(const std::filesystem::path& directory);

// The file's text, which reads back to the same.
std::string effects_file_text(const EffectGroups& groups);

}  // namespace floe

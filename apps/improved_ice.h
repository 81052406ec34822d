// An improved model of the ice as a directory: a copy of the base with new tables and a log of changes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "propagation/effects_file.h"
#include "propagation/model.h"

namespace floe {

// Where commands that improve ice leave it, within the folder of their results.
inline constexpr std::string_view improved_ice_folder = "improved-ice";

// Before the work: makes the folder, where there is none yet, with the files of the base directory, those
// that floe does not read, too. Folders within it stay behind. Built-in ice has no files. Throws OutputError.
void copy_base_ice(const ModelRequest& base, const std::filesystem::path& folder);

// Into a folder that copy_base_ice made. What the field's ice directories have no file for, of the base and
// `beside_ice`, goes to floe.toml, which floe reads and others ignore. Throws OutputError, and UsageError
// (expect_writable).
void write_improved_ice(const ModelRequest& base, const Model& improved, const EffectGroups& beside_ice,
                        const std::string& changes, const std::filesystem::path& folder);

}  // namespace floe

// An improved model of the ice as a directory: a copy of the base with new tables and a log of changes.
#pragma once

#include <filesystem>
#include <string>

#include "propagation/effects_file.h"
#include "propagation/model.h"

namespace floe {

// `beside_ice`: what the field's ice directories have no file for goes to floe.toml, which floe reads and
// others ignore. Throws OutputError.
void write_improved_ice(const ModelRequest& request, const Model& improved, const EffectGroups& beside_ice,
                        const std::string& changes, const std::filesystem::path& folder);

}  // namespace floe

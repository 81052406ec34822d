// Files of settings in TOML.
#pragma once

#include <string>
#include <toml.hpp>

#include "data/base/error.h"

namespace floe {

// Throws InputError, with the line and the parser's reason, for what is no TOML; `advice`: what to do then.
toml::value read_toml(const std::string& file, const std::string& advice);

Location place_of(const std::string& file, const toml::value& value);
// The line that a value stands on, without its indent, in quotes.
std::string quoted_line(const toml::value& value);

}  // namespace floe

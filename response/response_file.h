// The file of the electronics' settings: TOML, sections and keys as in response_settings.h.
#pragma once

#include <filesystem>
#include <string>

#include "response/response_settings.h"

namespace floe {

// What the file does not name keeps its default. Throws InputError with file and line: no TOML, an unknown
// section or key, a value of another kind or out of its range; and for numbers that do not fit together.
ResponseSettings read_response_file(const std::filesystem::path& path);

// All settings as such a file, each with what it means and where it is from.
std::string response_file_text(const ResponseSettings& settings);

}  // namespace floe

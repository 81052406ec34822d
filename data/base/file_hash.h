// What a file holds, in a few characters.
#pragma once

#include <filesystem>
#include <string>

namespace floe {

// A hash (data/base/hash.h) of a file's bytes, read in portions; of a file that cannot be read, that of an
// empty one: whoever reads its content next says what is wrong.
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace floe

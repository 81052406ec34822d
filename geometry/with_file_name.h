// Errors of a value that was read from a file name the file.
#pragma once

#include <filesystem>

#include "data/base/error.h"

namespace floe {

// What `make` returns; an InputError that it throws is thrown again with the file's name in front.
template <typename Make>
auto with_file_name(const std::filesystem::path& file, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

}  // namespace floe

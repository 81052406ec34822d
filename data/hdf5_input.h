// What all of floe's HDF5 files have in common when they are read: how a file is opened, its attributes, and
// the errors when it is not what it should be. Used by event files and diffusion patterns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "data/base/error.h"
#include "data/hdf5_handle.h"

namespace floe::hdf5 {

inline constexpr const char* remake_advice =
    "The file is truncated or damaged: copy it again or make it again";

// Attributes of a place, a file or a group, each one value. Throws InputError where one is missing or of
// another kind, Hdf5Failure where it cannot be read.
class AttributeReader {
 public:
  AttributeReader(hid_t place, const Location& where) : place_(place), where_(where) {}

  std::string text(const char* name) const;
  std::uint64_t whole(const char* name) const;
  double number(const char* name) const;

 private:
  Hdf5Handle open(const char* name, H5T_class_t kind, const char* kind_name) const;

  hid_t place_;
  const Location& where_;
};

// Throws InputError unless the file's attributes `format` and `format_version` are these.
void expect_format(const AttributeReader& attributes, const Location& where, const std::string& format,
                   std::uint64_t version);

// Throws InputError unless the file is there and begins as HDF5 does; `expected`: what it should be.
void expect_hdf5(const std::filesystem::path& path, const std::string& expected);
Hdf5Handle open_for_reading(const std::filesystem::path& path);
[[noreturn]] void throw_input_error(const std::filesystem::path& path, const Hdf5Failure& failure);

// What work(file, where) returns, without messages from HDF5 itself. Throws InputError as above, and where
// the work fails with Hdf5Failure.
template <typename Work>
auto read_file(const std::filesystem::path& path, const std::string& expected, const Work& work) {
  const Location where{path.string()};
  expect_hdf5(path, expected);
  const Hdf5Silence silence;
  try {
    const Hdf5Handle file = open_for_reading(path);
    return work(file, where);
  } catch (const Hdf5Failure& failure) {
    throw_input_error(path, failure);
  }
}

}  // namespace floe::hdf5

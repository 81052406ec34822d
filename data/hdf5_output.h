// What all of floe's HDF5 files have in common when they are written: how the file is made, its attributes,
// the layout of its data sets, and the error when it cannot be written. Used by event files and sky maps.
//
// Functions throw Hdf5Failure unless they say otherwise; `guarded` makes it the OutputError that users see.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "data/hdf5_handle.h"

namespace floe::hdf5 {

// An empty file, which replaces what is at `path`.
Hdf5Handle create_file(const std::filesystem::path& path);

// One value at `place`, a file or a group: UTF-8 text, a whole number or a number.
void write_attribute(hid_t place, const char* name, const std::string& text);
void write_attribute(hid_t place, const char* name, std::uint64_t value);
void write_attribute(hid_t place, const char* name, double value);

// For H5Dcreate: data compressed in chunks, each with a checksum. `chunk` is the shape of one, an extent > 0
// for each dimension of the data set.
Hdf5Handle compressed_layout(std::span<const hsize_t> chunk);

// The OutputError that says that `path` cannot be written, and why.
[[noreturn]] void throw_output_error(const std::filesystem::path& path, const Hdf5Failure& failure);

// Does `work` without messages from HDF5 itself; where it fails with Hdf5Failure, throws OutputError, which
// names `path`.
template <typename Work>
void guarded(const std::filesystem::path& path, const Work& work) {
  const Hdf5Silence silence;
  try {
    work();
  } catch (const Hdf5Failure& failure) {
    throw_output_error(path, failure);
  }
}

}  // namespace floe::hdf5

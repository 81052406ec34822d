#include "data/hdf5_output.h"

#include <fmt/format.h>

#include "data/base/error.h"
#include "data/hdf5_schema.h"

namespace floe::hdf5 {

namespace {

constexpr unsigned deflate_level = 4;

void write_scalar(hid_t place, const char* name, hid_t type, const void* value) {
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Hdf5Handle attribute(H5Acreate2(place, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "create an attribute");
  checked(H5Awrite(attribute, type, value), "write an attribute");
}

}  // namespace

Hdf5Handle create_file(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up the file");
  // From version 1.10 on all of HDF5's own structures carry checksums, so that damage is noticed.
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "set up the file");
  // The temporary file is ours alone, and locks fail on some network folders.
  checked(H5Pset_file_locking(access, false, true), "set up the file");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "create the file"};
}

// Text of fixed length stands where HDF5 keeps checksums; text of variable length does not, and damage
// there crashes the library in whoever reads the file.
void write_attribute(hid_t place, const char* name, const std::string& text) {
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  write_scalar(place, name, utf8_type(padded.size()), padded.data());
}

void write_attribute(hid_t place, const char* name, std::uint64_t value) {
  write_scalar(place, name, H5T_NATIVE_UINT64, &value);
}

void write_attribute(hid_t place, const char* name, double value) {
  write_scalar(place, name, H5T_NATIVE_DOUBLE, &value);
}

Hdf5Handle compressed_layout(std::span<const hsize_t> chunk) {
  Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a data set");
  checked(H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()), "set a data set's chunks");
  checked(H5Pset_shuffle(layout), "set a data set's compression");
  checked(H5Pset_deflate(layout, deflate_level), "set a data set's compression");
  checked(H5Pset_fletcher32(layout), "set a data set's checksum");
  // The same content gives the same bytes, whenever it is written.
  checked(H5Pset_obj_track_times(layout, false), "describe a data set");
  return layout;
}

void throw_output_error(const std::filesystem::path& path, const Hdf5Failure& failure) {
  throw OutputError(
      fmt::format("{}: cannot be written: {}. Is the disk full?", path.string(), failure.what()));
}

}  // namespace floe::hdf5

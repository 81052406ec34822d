#include "data/hdf5_input.h"

#include <fmt/format.h>

#include "data/base/text.h"
#include "data/hdf5_reader.h"

namespace floe::hdf5 {

namespace {

std::string fixed_text(const Hdf5Handle& attribute, const Hdf5Handle& type) {
  std::string value(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, value.data()), "read an attribute");
  return value.substr(0, value.find('\0'));
}

}  // namespace

// floe writes text of fixed length; h5py makes text of variable length, which is as good.
std::string AttributeReader::text(const char* name) const {
  const Hdf5Handle attribute = open(name, H5T_STRING, "text");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "read an attribute");
  if (checked(H5Tis_variable_str(type), "read an attribute") == 0) return fixed_text(attribute, type);
  char* value = nullptr;
  checked(H5Aread(attribute, type, &value), "read an attribute");
  const std::string result = value ? value : "";
  H5free_memory(value);
  return result;
}

std::uint64_t AttributeReader::whole(const char* name) const {
  std::uint64_t value = 0;
  checked(H5Aread(open(name, H5T_INTEGER, "a whole number"), H5T_NATIVE_UINT64, &value), "read an attribute");
  return value;
}

double AttributeReader::number(const char* name) const {
  double value = 0;
  checked(H5Aread(open(name, H5T_FLOAT, "a number"), H5T_NATIVE_DOUBLE, &value), "read an attribute");
  return value;
}

Hdf5Handle AttributeReader::open(const char* name, H5T_class_t kind, const char* kind_name) const {
  if (checked(H5Aexists(place_, name), "look for an attribute") == 0)
    throw InputError(where_, fmt::format("no attribute '{}'", name), "the attributes of docs/formats.md",
                     "Only HDF5 files that follow docs/formats.md can be read");
  Hdf5Handle attribute(H5Aopen(place_, name, H5P_DEFAULT), H5Aclose, "open an attribute");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "read an attribute");
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "read an attribute");
  if (H5Tget_class(type) != kind || H5Sget_simple_extent_npoints(space) != 1)
    throw InputError(where_, fmt::format("an attribute '{}' of another kind", name),
                     fmt::format("{}, one value", kind_name));
  return attribute;
}

void expect_format(const AttributeReader& attributes, const Location& where, const std::string& format,
                   std::uint64_t version) {
  const std::string found = attributes.text("format");
  if (found != format)
    throw InputError(where, "the format " + in_quotes(found), fmt::format("'{}'", format),
                     "Only HDF5 files that follow docs/formats.md can be read");
  const std::uint64_t found_version = attributes.whole("format_version");
  if (found_version != version)
    throw InputError(where, fmt::format("version {} of the format", found_version),
                     fmt::format("version {}", version), "Use the release of floe that wrote the file");
}

void expect_hdf5(const std::filesystem::path& path, const std::string& expected) {
  if (is_hdf5(path)) return;
  const bool empty = std::filesystem::file_size(path) == 0;
  throw InputError({path.string()}, empty ? "an empty file" : "a file that is not HDF5", expected);
}

Hdf5Handle open_for_reading(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up the file");
  checked(H5Pset_file_locking(access, false, true), "set up the file");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "open the file"};
}

void throw_input_error(const std::filesystem::path& path, const Hdf5Failure& failure) {
  throw InputError({path.string()}, fmt::format("HDF5 that cannot be read ({})", failure.what()),
                   "a whole HDF5 file", remake_advice);
}

}  // namespace floe::hdf5

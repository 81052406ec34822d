#include "reco/direct_fit/sky_map_file.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "data/base/error.h"
#include "data/hdf5_schema.h"

namespace floe {
namespace {

constexpr const char* format_name = "floe-sky-map";
constexpr std::uint64_t format_version = 1;
constexpr unsigned deflate_level = 4;

Hdf5Handle create_file(const std::filesystem::path& path) {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up the file");
  // As event files have it: checksums on HDF5's own structures, and no locks on network folders.
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "set up the file");
  checked(H5Pset_file_locking(access, false, true), "set up the file");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "create the file"};
}

void write_attribute(hid_t place, const char* name, hid_t type, const void* value) {
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
  const Hdf5Handle attribute(H5Acreate2(place, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "create an attribute");
  checked(H5Awrite(attribute, type, value), "write an attribute");
}

void write_attribute(hid_t place, const char* name, const std::string& text) {
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  write_attribute(place, name, hdf5::utf8_type(padded.size()), padded.data());
}

void write_attribute(hid_t place, const char* name, double value) {
  write_attribute(place, name, H5T_NATIVE_DOUBLE, &value);
}

// One number a pixel.
void write_pixels(hid_t group, const char* name, const SkyMap& map, const std::vector<double>& values) {
  const auto n = static_cast<hsize_t>(map.pixels);
  const std::array<hsize_t, 2> shape{n, n};
  const Hdf5Handle space(H5Screate_simple(2, shape.data(), nullptr), H5Sclose, "describe a map");
  const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a map");
  checked(H5Pset_chunk(layout, 2, shape.data()), "set a map's chunks");
  checked(H5Pset_shuffle(layout), "set a map's compression");
  checked(H5Pset_deflate(layout, deflate_level), "set a map's compression");
  checked(H5Pset_fletcher32(layout), "set a map's checksum");
  // The same maps give the same bytes, whenever they are written.
  checked(H5Pset_obj_track_times(layout, false), "describe a map");
  const Hdf5Handle set(H5Dcreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, layout, H5P_DEFAULT),
                       H5Dclose, "create a map");
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write a map");
}

void write_directions(hid_t group, const SkyMap& map) {
  std::vector<double> zenith, azimuth;
  for (int row = 0; row < map.pixels; ++row)
    for (int column = 0; column < map.pixels; ++column) {
      const Origin origin = map.direction_at(row, column);
      zenith.push_back(origin.zenith / degree);
      azimuth.push_back(origin.azimuth / degree);
    }
  write_pixels(group, "zenith_deg", map, zenith);
  write_pixels(group, "azimuth_deg", map, azimuth);
}

void write_map(hid_t file, const std::string& name, const SkyMapOfEvent& entry) {
  const SkyMap& map = entry.map;
  const Hdf5Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                         "create a group");
  write_attribute(group, "event", entry.event);
  write_attribute(group, "zenith_deg", map.zenith / degree);
  write_attribute(group, "azimuth_deg", map.azimuth / degree);
  write_attribute(group, "step_deg", map.step / degree);
  for (const int percent : {50, 90, 99}) {
    const double share = percent / 100.0;
    const std::uint64_t cut = map.is_cut(share);
    write_attribute(group, fmt::format("level_{}", percent).c_str(), level_of(share));
    write_attribute(group, fmt::format("area_{}_deg2", percent).c_str(), map.area(share));
    write_attribute(group, fmt::format("cut_{}", percent).c_str(), H5T_NATIVE_UINT64, &cut);
  }
  write_pixels(group, "delta_neg_llh", map, map.delta_neg_llh);
  write_directions(group, map);
}

}  // namespace

void write_sky_maps(AtomicFile& file, const SkyMapProvenance& provenance,
                    std::span<const SkyMapOfEvent> maps) {
  const Hdf5Silence silence;
  try {
    Hdf5Handle handle = create_file(file.temporary());
    write_attribute(handle, "format", std::string(format_name));
    write_attribute(handle, "format_version", H5T_NATIVE_UINT64, &format_version);
    write_attribute(handle, "version", provenance.version);
    write_attribute(handle, "ice_name", provenance.ice_name);
    write_attribute(handle, "ice_hash", provenance.ice_hash);
    for (std::size_t i = 0; i < maps.size(); ++i) write_map(handle, fmt::format("event_{}", i), maps[i]);
    handle.close("close the file");
  } catch (const Hdf5Failure& failure) {
    throw OutputError(fmt::format("{}: cannot be written: {}. Is the disk full?", file.temporary().string(),
                                  failure.what()));
  }
  file.commit();
}

}  // namespace floe

#include "reco/direct_fit/sky_map_file.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "data/hdf5_output.h"

namespace floe {

using namespace hdf5;

namespace {

constexpr const char* format_name = "floe-sky-map";
constexpr std::uint64_t format_version = 1;

// One number a pixel.
void write_pixels(hid_t group, const char* name, const SkyMap& map, const std::vector<double>& values) {
  const auto n = static_cast<hsize_t>(map.pixels);
  const std::array<hsize_t, 2> shape{n, n};
  const Hdf5Handle space(H5Screate_simple(2, shape.data(), nullptr), H5Sclose, "describe a map");
  const Hdf5Handle layout = compressed_layout(shape);
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
  write_attribute(group, "errors_are_wider", std::uint64_t{map.errors_are_wider});
  for (const int percent : {50, 90, 99}) {
    const double share = percent / 100.0;
    write_attribute(group, fmt::format("level_{}", percent).c_str(), level_of(share));
    write_attribute(group, fmt::format("area_{}_deg2", percent).c_str(), map.area(share));
    write_attribute(group, fmt::format("cut_{}", percent).c_str(), std::uint64_t{map.is_cut(share)});
  }
  write_pixels(group, "delta_neg_llh", map, map.delta_neg_llh);
  write_directions(group, map);
}

}  // namespace

void write_sky_maps(AtomicFile& file, const SkyMapProvenance& provenance,
                    std::span<const SkyMapOfEvent> maps) {
  guarded(file.temporary(), [&] {
    Hdf5Handle handle = create_file(file.temporary());
    write_attribute(handle, "format", format_name);
    write_attribute(handle, "format_version", format_version);
    write_attribute(handle, "version", provenance.version);
    write_attribute(handle, "ice_name", provenance.ice_name);
    write_attribute(handle, "ice_hash", provenance.ice_hash);
    for (std::size_t i = 0; i < maps.size(); ++i) write_map(handle, fmt::format("event_{}", i), maps[i]);
    handle.close("close the file");
  });
  file.commit();
}

}  // namespace floe

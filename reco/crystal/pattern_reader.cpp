#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/base/vec3.h"
#include "data/hdf5_input.h"
#include "reco/crystal/pattern_file.h"
#include "reco/crystal/pattern_schema.h"

namespace floe {

using namespace hdf5;

namespace {

constexpr const char* written_by = "diffusion patterns as 'floe crystal -o' writes them";

struct Array {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

Array read_array(hid_t place, const char* name, const Location& where) {
  if (checked(H5Lexists(place, name, H5P_DEFAULT), "look for an array") == 0)
    throw InputError(where, fmt::format("no data set '{}'", name), written_by);
  const Hdf5Handle set(H5Dopen2(place, name, H5P_DEFAULT), H5Dclose, "open an array");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "read an array's size");
  Array array;
  array.shape.resize(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space), "read a size")));
  checked(H5Sget_simple_extent_dims(space, array.shape.data(), nullptr), "read an array's size");
  array.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  checked(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()),
          "read an array");
  if (!std::all_of(array.values.begin(), array.values.end(), [](double v) { return std::isfinite(v); }))
    throw InputError(where, fmt::format("a value of '{}' that is no number", name), "finite numbers");
  return array;
}

// One value an angle.
std::vector<double> read_values(hid_t place, const char* name, std::size_t angles, double low, double high,
                                const Location& where) {
  const Array array = read_array(place, name, where);
  const auto valid = [&](double value) { return low <= value && value <= high; };
  if (array.values.size() != angles || !std::all_of(array.values.begin(), array.values.end(), valid))
    throw InputError(where, fmt::format("a data set '{}' of {} values", name, array.values.size()),
                     fmt::format("{} values from {:g} to {:g}, one an angle", angles, low, high));
  return array.values;
}

std::vector<WalkedPhoton> photons_of(const double* values, std::size_t count) {
  std::vector<WalkedPhoton> photons(count);
  for (std::size_t i = 0; i < count; ++i, values += photon_columns)
    photons[i] = {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
  return photons;
}

PatternGrid read_grid(const AttributeReader& attributes) {
  PatternGrid grid;
  grid.crystal.indices = {attributes.number("n_ordinary"), attributes.number("n_extraordinary")};
  grid.crystal.grains.axes = {attributes.number("axis_flow"), attributes.number("axis_tilt"),
                              attributes.number("axis_vertical")};
  grid.grain = attributes.number("grain_m");
  grid.crossings = static_cast<int>(attributes.whole("crossings"));
  grid.chords = attributes.whole("chords") != 0;
  grid.seed = attributes.whole("seed");
  grid.first_photon = attributes.whole("first_photon");
  return grid;
}

CrystalStudy read_study(hid_t file, const std::string& name, const Location& where) {
  const Hdf5Handle group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, "open a group");
  const AttributeReader attributes(group, where);
  PatternGrid grid = read_grid(attributes);
  const Array photons = read_array(group, "photons", where);
  const bool fits = photons.shape.size() == 3 && photons.shape[1] >= fewest_pattern_photons &&
                    photons.shape[2] == photon_columns;
  if (!fits)
    throw InputError(where, fmt::format("photons of another shape in '{}'", name),
                     fmt::format("angles, {} photons or more, {} numbers of each", fewest_pattern_photons,
                                 photon_columns));
  const std::size_t angles = photons.shape[0];
  grid.photons = photons.shape[1];
  grid.angles = read_values(group, "angle_deg", angles, 0, 90, where);
  for (double& angle : grid.angles) angle *= degree;
  const auto crossings = read_values(group, "crossings", angles, 1, 1e9, where),
             lengths = read_values(group, "length_m", angles, 1e-9, 1e9, where);
  std::vector<CrystalPattern> patterns;
  for (std::size_t i = 0; i < angles; ++i) {
    auto of_angle = photons_of(photons.values.data() + i * grid.photons * photon_columns, grid.photons);
    const PatternStatistics statistics(of_angle, lengths[i]);
    patterns.push_back(
        {grid.angles[i], static_cast<int>(crossings[i]), lengths[i], std::move(of_angle), statistics});
  }
  return {attributes.text("name"), attributes.text("fabric"), grid, std::move(patterns), {}, {}, {}};
}

}  // namespace

PatternFile read_patterns(const std::filesystem::path& path) {
  return read_file(path, written_by, [&](hid_t file, const Location& where) {
    const AttributeReader attributes(file, where);
    expect_format(attributes, where, pattern_format, pattern_format_version);
    PatternFile result{
        path.string(),
        {attributes.text("version"), attributes.text("command"), attributes.number("wavelength_nm")},
        {}};
    for (;;) {
      const std::string name = fmt::format("ice_{}", result.studies.size());
      if (checked(H5Lexists(file, name.c_str(), H5P_DEFAULT), "look for a group") == 0) break;
      result.studies.push_back(read_study(file, name, where));
    }
    if (result.studies.empty()) throw InputError(where, "no patterns", written_by);
    return result;
  });
}

}  // namespace floe

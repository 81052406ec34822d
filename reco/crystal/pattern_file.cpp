#include "reco/crystal/pattern_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "data/hdf5_output.h"
#include "reco/crystal/pattern_schema.h"

namespace floe {

using namespace hdf5;

namespace {

constexpr hsize_t photons_per_chunk = 4096;

void write_array(hid_t place, const char* name, std::span<const hsize_t> shape,
                 std::span<const hsize_t> chunk, const std::vector<double>& values) {
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                         "describe an array");
  const Hdf5Handle layout = compressed_layout(chunk);
  const Hdf5Handle set(H5Dcreate2(place, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, layout, H5P_DEFAULT),
                       H5Dclose, "create an array");
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write an array");
}

void write_numbers(hid_t place, const std::string& name, const std::vector<double>& values) {
  const std::array<hsize_t, 1> shape{values.size()};
  write_array(place, name.c_str(), shape, shape, values);
}

Hdf5Handle make_group(hid_t place, const std::string& name) {
  return {H5Gcreate2(place, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create a group"};
}

// One value an angle, by a function of the pattern.
template <typename Function>
std::vector<double> by_angle(const CrystalStudy& study, const Function& function) {
  std::vector<double> values;
  for (const CrystalPattern& pattern : study.patterns) values.push_back(function(pattern));
  return values;
}

void write_statistics(hid_t place, const CrystalStudy& study) {
  const Hdf5Handle group = make_group(place, "statistics");
  for (std::size_t i = 0; i < pattern_numbers; ++i) {
    const auto number = static_cast<PatternNumber>(i);
    const std::string name(name_of(number));
    write_numbers(group, name, by_angle(study, [&](const auto& p) { return p.statistics[number].value; }));
    write_numbers(group, name + "_error",
                  by_angle(study, [&](const auto& p) { return p.statistics[number].error; }));
  }
}

void write_fit(hid_t place, const char* name, const DiffusionFit& fit) {
  const Hdf5Handle group = make_group(place, name);
  for (std::size_t i = 0; i < fit.functions.size(); ++i) {
    const FunctionFit& function = fit.functions[i];
    const Hdf5Handle one = make_group(group, std::string(diffusion_names[i]));
    const auto write_four = [&](const char* what, const DiffusionFunction& f) {
      write_numbers(one, what, {f.A, f.B, f.C, f.D});
    };
    write_four("ABCD", function.numbers);
    write_four("ABCD_error", function.errors);
    write_attribute(one, "chi_square", function.chi_square);
    write_attribute(one, "degrees_of_freedom", static_cast<std::uint64_t>(function.degrees_of_freedom));
    write_attribute(one, "worst", function.worst);
    write_attribute(one, "D_held", std::uint64_t{function.D_held});
  }
}

// All photons: [angle][photon][direction x, y, n, position x, y, n], in full: whoever reads them again finds
// the same statistics.
void write_photons(hid_t place, const CrystalStudy& study) {
  const hsize_t photons = study.grid.photons;
  std::vector<double> values;
  values.reserve(study.patterns.size() * photons * photon_columns);
  for (const CrystalPattern& pattern : study.patterns)
    for (const WalkedPhoton& photon : pattern.photons)
      for (const Vec3& vector : {photon.direction, photon.position})
        for (int axis = 0; axis < 3; ++axis) values.push_back(vector[axis]);
  const std::array<hsize_t, 3> shape{study.patterns.size(), photons, photon_columns};
  const std::array<hsize_t, 3> chunk{1, std::min(photons, photons_per_chunk), photon_columns};
  write_array(place, "photons", shape, chunk, values);
}

void write_ice(hid_t place, const CrystalStudy& study) {
  const PatternGrid& grid = study.grid;
  const auto& axes = grid.crystal.grains.axes;
  write_attribute(place, "name", study.name);
  write_attribute(place, "fabric", study.fabric);
  write_attribute(place, "n_ordinary", grid.crystal.indices.ordinary);
  write_attribute(place, "n_extraordinary", grid.crystal.indices.extraordinary);
  write_attribute(place, "axis_flow", axes[0]);
  write_attribute(place, "axis_tilt", axes[1]);
  write_attribute(place, "axis_vertical", axes[2]);
  write_attribute(place, "grain_m", grid.grain);
  write_attribute(place, "crossings", static_cast<std::uint64_t>(grid.crossings));
  write_attribute(place, "chords", std::uint64_t{grid.chords});
  write_attribute(place, "seed", std::uint64_t{grid.seed});
  write_attribute(place, "first_photon", std::uint64_t{grid.first_photon});
}

void write_study(hid_t file, const std::string& name, const CrystalStudy& study) {
  const Hdf5Handle group = make_group(file, name);
  write_ice(group, study);
  write_numbers(group, "angle_deg", by_angle(study, [](const auto& p) { return p.angle / degree; }));
  write_numbers(group, "crossings",
                by_angle(study, [](const auto& p) { return static_cast<double>(p.crossings); }));
  write_numbers(group, "length_m", by_angle(study, [](const auto& p) { return p.length; }));
  write_statistics(group, study);
  if (study.core) write_fit(group, "fit_core", *study.core);
  if (study.all) write_fit(group, "fit_all", *study.all);
  write_photons(group, study);
}

}  // namespace

void write_patterns(AtomicFile& file, const PatternProvenance& provenance,
                    std::span<const CrystalStudy> studies) {
  guarded(file.temporary(), [&] {
    Hdf5Handle handle = create_file(file.temporary());
    write_attribute(handle, "format", pattern_format);
    write_attribute(handle, "format_version", pattern_format_version);
    write_attribute(handle, "version", provenance.version);
    write_attribute(handle, "command", provenance.command);
    write_attribute(handle, "wavelength_nm", provenance.wavelength);
    for (std::size_t i = 0; i < studies.size(); ++i)
      write_study(handle, fmt::format("ice_{}", i), studies[i]);
    handle.close("close the file");
  });
  file.commit();
}

}  // namespace floe

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "data/base/atomic_file.h"
#include "propagation/ice/ice_files.h"
#include "propagation/ice/ice_tables.h"

namespace floe {

namespace {

namespace fs = std::filesystem;

// Numbers in the shortest form that reads back to the same bits (fmt's "{}"), blanks between.
std::string row_of(const std::vector<double>& numbers) {
  return fmt::format("{}\n", fmt::join(numbers, " "));
}

// All rows of a file have the same columns; k1 and k2 of rows that leave them to the directory are
// written as the directory's where other rows or later columns need them.
std::string layers_text(const IceTables& tables) {
  const auto any = [&](auto has) { return std::any_of(tables.layers.begin(), tables.layers.end(), has); };
  const bool deflection = any([](const auto& row) { return row.deflection_strength != 1; });
  const bool strength = deflection || any([](const auto& row) { return row.birefringence_strength != 1; });
  const bool anisotropy = strength || any([](const auto& row) { return row.k1 || row.k2; });
  std::string text;
  for (const auto& row : tables.layers) {
    std::vector<double> numbers{row.depth, row.effective_scattering, row.dust_absorption,
                                row.temperature_difference};
    if (anisotropy) {
      numbers.push_back(row.k1.value_or(tables.configuration.k1));
      numbers.push_back(row.k2.value_or(tables.configuration.k2));
    }
    if (strength) numbers.push_back(row.birefringence_strength);
    if (deflection) numbers.push_back(row.deflection_strength);
    text += row_of(numbers);
  }
  return text;
}

std::string wavelength_text(const WavelengthDependence& wavelength) {
  std::vector<double> values{wavelength.alpha, wavelength.kappa, wavelength.A, wavelength.B};
  if (wavelength.D || wavelength.E)
    values.insert(values.end(), {wavelength.D.value_or(0), wavelength.E.value_or(0)});
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) text += row_of({values[i], wavelength.uncertainty[i]});
  return text;
}

void append_function(std::string& text, const DiffusionFunction& function, std::string_view name) {
  text += fmt::format("{}  # {}: A\n{}  # B\n{}  # C\n{}  # D\n", function.A, name, function.B, function.C,
                      function.D);
}

std::string configuration_text(const IceConfiguration& c) {
  std::string text = "# ice model: numbers in a fixed order, one a line\n";
  const auto add = [&](double value, std::string_view meaning) {
    text += fmt::format("{}  # {}\n", value, meaning);
  };
  add(c.oversize, "oversize of the modules");
  add(c.module_efficiency, "overall efficiency of the modules");
  add(c.simplified_liu_fraction, "fraction of simplified Liu scattering");
  add(c.mean_cosine, "mean cosine of the scattering angle");
  add(c.flow_azimuth_deg, "azimuth of the ice flow [deg]");
  add(c.k1, "scattering anisotropy k1");
  add(c.k2, "scattering anisotropy k2");
  add(c.hole_ice.radius, "hole ice: radius [module radii]");
  add(c.hole_ice.effective_scattering_length, "hole ice: effective scattering length [m]");
  add(c.hole_ice.absorption_length, "hole ice: absorption length [m]");
  add(c.hole_ice.simplified_liu_fraction, "hole ice: fraction of simplified Liu scattering");
  add(c.hole_ice.mean_cosine, "hole ice: mean cosine of the scattering angle");

  const bool old_scaling = c.old_absorption_scaling != 1 || c.birefringence;
  if (c.absorption_anisotropy || old_scaling) {
    const auto absorption = c.absorption_anisotropy.value_or(IceConfiguration::AbsorptionAnisotropy{});
    add(absorption.k1, "absorption anisotropy k1");
    add(absorption.k2, "absorption anisotropy k2");
    add(absorption.kz, "absorption anisotropy kz");
  }
  if (old_scaling) add(c.old_absorption_scaling, "scaling of the old absorption anisotropy");
  if (c.birefringence) {
    append_function(text, c.birefringence->sigma_x, "birefringence, sigma_x");
    append_function(text, c.birefringence->sigma_y, "birefringence, sigma_y");
    append_function(text, c.birefringence->mean_x, "birefringence, m_x");
  }
  return text;
}

std::string shifts_text(const std::vector<double>& depths, const std::vector<std::vector<double>>& shifts) {
  std::string text;
  for (std::size_t i = 0; i < depths.size(); ++i) text += fmt::format("{} {}", depths[i], row_of(shifts[i]));
  return text;
}

std::string distances_text(const TiltLines& tilt) {
  std::string text;
  for (std::size_t i = 0; i < tilt.distances.size(); ++i)
    text += fmt::format("{} {}\n", tilt.strings[i], tilt.distances[i]);
  return text;
}

std::string axis_text(const TiltMap::Axis& axis) {
  return fmt::format("{} {} {} {} {}\n", axis.direction_deg, axis.start, axis.step, axis.count, axis.cut);
}

// A file that the tables have no content for would be read back as if it belonged to them.
void write_or_remove(const fs::path& file, const std::optional<std::string>& text) {
  if (text) return write_whole_file(file, *text);
  std::error_code error;
  fs::remove(file, error);
  if (error) throw OutputError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
}

}  // namespace

void expect_writable(const IceTables& tables) {
  const auto& birefringence = tables.configuration.birefringence;
  if (!birefringence) return;
  if (!birefringence->diffusion || !birefringence->deflection || !birefringence->displacement)
    throw UsageError(
        "an ice-model directory cannot say that a part of birefringence is off; switch off "
        "birefringence as a whole or none of its parts before writing");
}

void write_ice_tables(const IceTables& tables, const fs::path& directory) {
  expect_writable(tables);
  using Text = std::optional<std::string>;
  const auto& lines = tables.tilt_lines;
  const auto& map = tables.tilt_map;
  write_whole_file(directory / ice_files::layers_file, layers_text(tables));
  write_whole_file(directory / ice_files::wavelength_file, wavelength_text(tables.wavelength));
  write_whole_file(directory / ice_files::configuration_file, configuration_text(tables.configuration));

  const auto& b = tables.bubbles;
  write_or_remove(directory / ice_files::bubbles_file, b ? Text(row_of({b->b, b->d1, b->d2})) : Text());
  write_or_remove(directory / ice_files::version_file,
                  tables.version != 0 ? Text(fmt::format("{}\n", tables.version)) : Text());
  write_or_remove(directory / ice_files::tilt_distances_file, lines ? Text(distances_text(*lines)) : Text());
  write_or_remove(directory / ice_files::tilt_lines_file,
                  lines ? Text(shifts_text(lines->depths, lines->shifts)) : Text());
  write_or_remove(directory / ice_files::tilt_grid_file,
                  map ? Text(axis_text(map->first) + axis_text(map->second)) : Text());
  write_or_remove(directory / ice_files::tilt_map_file,
                  map ? Text(shifts_text(map->depths, map->shifts)) : Text());
}

}  // namespace floe

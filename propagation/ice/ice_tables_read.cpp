#include <fmt/format.h>

#include <algorithm>

#include "data/base/text.h"
#include "propagation/ice/ice_files.h"
#include "propagation/ice/ice_tables.h"

namespace floe {

namespace {

namespace fs = std::filesystem;
namespace limits = ice_limits;
using ice_files::read_number;

constexpr std::string_view layer_layout =
    "4, 6, 7 or 8 columns: depth, effective scattering, dust absorption, delta-tau [, k1, k2 [, A [, B]]]";

IceLayerRow read_layer(const TextLine& line) {
  expect_fields(line, 4, 8, layer_layout);
  const std::size_t columns = line.fields.size();
  if (columns == 5) throw InputError(line.where, "5 columns", layer_layout);
  IceLayerRow row;
  row.depth = read_number(line, 0, limits::depth);
  row.effective_scattering = read_number(line, 1, limits::effective_scattering);
  row.dust_absorption = read_number(line, 2, limits::dust_absorption);
  row.temperature_difference = read_number(line, 3, limits::temperature_difference);
  if (columns >= 6) {
    row.k1 = read_number(line, 4, limits::anisotropy);
    row.k2 = read_number(line, 5, limits::anisotropy);
  }
  if (columns >= 7) row.birefringence_strength = read_number(line, 6, limits::birefringence_strength);
  if (columns >= 8) row.deflection_strength = read_number(line, 7, limits::deflection_strength);
  return row;
}

std::vector<IceLayerRow> read_layers(const fs::path& file) {
  const auto lines = read_text_lines(file);
  if (lines.empty()) throw InputError({file.string()}, "no layers", "one row a layer", "");
  std::vector<IceLayerRow> rows;
  std::vector<double> depths;
  for (const auto& line : lines) {
    rows.push_back(read_layer(line));
    depths.push_back(rows.back().depth);
    if (line.fields.size() != lines.front().fields.size())
      throw InputError(line.where, fmt::format("{} columns", line.fields.size()),
                       fmt::format("{} columns as in the first row", lines.front().fields.size()));
  }
  ice_files::expect_uniform(lines, depths);
  return rows;
}

WavelengthDependence read_wavelength_dependence(const fs::path& file) {
  const auto lines = read_text_lines(file);
  if (lines.size() != 4 && lines.size() != 6)
    throw InputError({file.string()}, ice_files::rows_found(lines),
                     "4 rows (alpha, kappa, A, B) or 6 (and D, E), each a value and its uncertainty");
  const std::array ranges{
      limits::alpha,           limits::kappa, limits::thermal_A, limits::thermal_B, limits::dust_coefficient,
      limits::dust_coefficient};
  std::array<double, 6> values{};
  WavelengthDependence result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    expect_fields(lines[i], 2, 2, "a value and its uncertainty");
    values[i] = read_number(lines[i], 0, ranges[i]);
    result.uncertainty[i] = read_number(lines[i], 1, limits::uncertainty);
  }
  result.alpha = values[0], result.kappa = values[1], result.A = values[2], result.B = values[3];
  if (lines.size() == 6) result.D = values[4], result.E = values[5];
  return result;
}

Bubbles read_bubbles(const fs::path& file) {
  const auto lines = read_text_lines(file);
  if (lines.size() != 1)
    throw InputError({file.string()}, ice_files::rows_found(lines), "one row: b, d1, d2");
  expect_fields(lines[0], 3, 3, "b, d1, d2");
  return {read_number(lines[0], 0, limits::bubble_scattering), read_number(lines[0], 1, limits::bubble_depth),
          read_number(lines[0], 2, limits::bubble_depth)};
}

int read_version(const fs::path& file) {
  const auto lines = read_text_lines(file);
  if (lines.size() != 1)
    throw InputError({file.string()}, ice_files::rows_found(lines), "one number: 0, 10 or 20");
  expect_fields(lines[0], 1, 1, "one number: 0, 10 or 20");
  const long version = parse_integer(lines[0], 0, "version of the ice model");
  if (version < 0 || version > 99 || !ice_files::is_supported(static_cast<int>(version)))
    throw InputError(lines[0].where, fmt::format("version {}", version), "version 0, 10 or 20");
  return static_cast<int>(version);
}

void expect_directory(const fs::path& directory) {
  if (!fs::exists(directory))
    throw InputError({directory.string()}, "no such directory", "an ice-model directory",
                     "Name a directory that holds icemodel.dat");
  if (!fs::is_directory(directory))
    throw InputError({directory.string()}, "a file", "an ice-model directory",
                     "Name the directory that holds icemodel.dat");
  if (!fs::exists(directory / ice_files::layers_file))
    throw InputError({directory.string()}, "no icemodel.dat",
                     "an ice-model directory with at least icemodel.dat, icemodel.par and cfg.txt");
}

std::string directory_name(const fs::path& directory) {
  auto path = fs::absolute(directory).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // written with a slash at the end
  return path.filename().string();
}

// Both files of a pair, or none.
bool has_pair(const fs::path& directory, std::string_view first, std::string_view second) {
  const bool has_first = fs::exists(directory / first), has_second = fs::exists(directory / second);
  if (has_first != has_second)
    throw InputError({directory.string()},
                     fmt::format("{} without {}", has_first ? first : second, has_first ? second : first),
                     "both files of the tilt, or neither");
  return has_first;
}

}  // namespace

IceTables read_ice_tables(const fs::path& directory, std::optional<int> version) {
  if (version && !ice_files::is_supported(*version))
    throw UsageError(fmt::format("ice version {} is not known; known are 0, 10 and 20", *version));
  expect_directory(directory);
  IceTables tables;
  tables.name = directory_name(directory);
  tables.layers = read_layers(directory / ice_files::layers_file);
  tables.wavelength = read_wavelength_dependence(directory / ice_files::wavelength_file);
  tables.configuration = ice_files::read_configuration(directory / ice_files::configuration_file);
  if (fs::exists(directory / ice_files::bubbles_file))
    tables.bubbles = read_bubbles(directory / ice_files::bubbles_file);
  if (fs::exists(directory / ice_files::version_file))
    tables.version = read_version(directory / ice_files::version_file);
  if (version) tables.version = *version;
  if (has_pair(directory, ice_files::tilt_distances_file, ice_files::tilt_lines_file))
    tables.tilt_lines = ice_files::read_tilt_lines(directory / ice_files::tilt_distances_file,
                                                   directory / ice_files::tilt_lines_file);
  if (has_pair(directory, ice_files::tilt_grid_file, ice_files::tilt_map_file))
    tables.tilt_map =
        ice_files::read_tilt_map(directory / ice_files::tilt_grid_file, directory / ice_files::tilt_map_file);
  return tables;
}

}  // namespace floe

// What the reader and the writer of ice-model directories share: names of files, order of numbers.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/base/text.h"
#include "propagation/ice/ice_limits.h"
#include "propagation/ice/ice_tables.h"

namespace floe::ice_files {

inline constexpr std::string_view layers_file = "icemodel.dat", wavelength_file = "icemodel.par",
                                  bubbles_file = "icemodel.bbl", configuration_file = "cfg.txt",
                                  tilt_distances_file = "tilt.par", tilt_lines_file = "tilt.dat",
                                  tilt_grid_file = "tilt.set", tilt_map_file = "tilt.map",
                                  version_file = "version";

// Depths are uniform when no step differs from the mean by more than this share of it.
inline constexpr double depth_tolerance = 1e-5;

inline constexpr std::array supported_versions{0, 10, 20};
bool is_supported(int version);

// The grid points of a 2D tilt that exist: the corners off the grid's diagonal are cut.
inline bool is_kept(const TiltMap& map, int i, int j) {
  return i < j + map.first.cut && j < i + map.second.cut;
}
std::size_t kept_points(const TiltMap& map);

// Index of the first depth that breaks the rule "rising, in uniform steps"; none when all obey.
std::optional<std::size_t> first_irregular(const std::vector<double>& depths);

// "1 row", "3 rows": what a file held instead of what it should.
std::string rows_found(const std::vector<TextLine>& lines);
// A number within its range.
double read_number(const TextLine& line, std::size_t field, const ice_limits::Range& range);
// Throws InputError at the line of the first irregular depth; lines and depths run in parallel.
void expect_uniform(const std::vector<TextLine>& lines, const std::vector<double>& depths);

IceConfiguration read_configuration(const std::filesystem::path& file);
TiltLines read_tilt_lines(const std::filesystem::path& par, const std::filesystem::path& dat);
TiltMap read_tilt_map(const std::filesystem::path& set, const std::filesystem::path& map);

}  // namespace floe::ice_files

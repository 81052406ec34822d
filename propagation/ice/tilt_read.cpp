// tilt.par and tilt.dat (1D), tilt.set and tilt.map (2D).
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "propagation/ice/ice_files.h"

namespace floe::ice_files {

namespace {

namespace limits = ice_limits;
namespace fs = std::filesystem;

struct ShiftTable {
  std::vector<double> depths;
  std::vector<std::vector<double>> shifts;
};

// Rows of a depth and `columns` shifts.
ShiftTable read_shifts(const fs::path& file, std::size_t columns, std::string_view counted_in) {
  const auto lines = read_text_lines(file);
  if (lines.size() < 2) throw InputError({file.string()}, rows_found(lines), "at least 2 depths");
  ShiftTable table;
  const std::string layout =
      fmt::format("a depth and {} layer shifts, as many as {} has places", columns, counted_in);
  for (const auto& line : lines) {
    expect_fields(line, columns + 1, columns + 1, layout);
    table.depths.push_back(read_number(line, 0, limits::depth));
    auto& row = table.shifts.emplace_back();
    for (std::size_t i = 1; i <= columns; ++i) row.push_back(read_number(line, i, limits::tilt_shift));
  }
  expect_uniform(lines, table.depths);
  return table;
}

TiltMap::Axis read_axis(const TextLine& line) {
  expect_fields(line, 5, 5, "direction [deg], start [m], step [m], count, corner cut");
  TiltMap::Axis axis{};
  axis.direction_deg = read_number(line, 0, limits::tilt_direction_deg);
  axis.start = read_number(line, 1, limits::tilt_distance);
  axis.step = read_number(line, 2, limits::tilt_step);
  const long count = parse_integer(line, 3, limits::tilt_count.what);
  expect_range(line, static_cast<double>(count), limits::tilt_count.low, limits::tilt_count.high,
               limits::tilt_count.what);
  const long cut = parse_integer(line, 4, limits::tilt_cut.what);
  expect_range(line, static_cast<double>(cut), limits::tilt_cut.low, limits::tilt_cut.high,
               limits::tilt_cut.what);
  axis.count = static_cast<int>(count), axis.cut = static_cast<int>(cut);
  return axis;
}

}  // namespace

TiltLines read_tilt_lines(const fs::path& par, const fs::path& dat) {
  const auto lines = read_text_lines(par);
  if (lines.size() < 2)
    throw InputError({par.string()}, rows_found(lines), "at least 2 rows of string and distance [m]");
  TiltLines tilt;
  for (const auto& line : lines) {
    expect_fields(line, 2, 2, "string, distance along 225 deg [m]");
    tilt.strings.push_back(static_cast<int>(parse_integer(line, 0, "string")));
    const double distance = read_number(line, 1, limits::tilt_distance);
    if (!tilt.distances.empty() && distance <= tilt.distances.back())
      throw InputError(line.where, fmt::format("distance {} m after {} m", distance, tilt.distances.back()),
                       "distances that rise from row to row");
    tilt.distances.push_back(distance);
  }
  if (std::find(tilt.distances.begin(), tilt.distances.end(), 0.0) == tilt.distances.end())
    throw InputError({par.string()}, "no distance 0", "one string at distance 0, the origin");
  auto table = read_shifts(dat, tilt.distances.size(), par.filename().string());
  tilt.depths = std::move(table.depths), tilt.shifts = std::move(table.shifts);
  return tilt;
}

TiltMap read_tilt_map(const fs::path& set, const fs::path& map) {
  const auto lines = read_text_lines(set);
  if (lines.size() != 2) throw InputError({set.string()}, rows_found(lines), "2 rows, one a grid axis");
  TiltMap tilt{read_axis(lines[0]), read_axis(lines[1]), {}, {}};
  if (tilt.first.cut + tilt.second.cut < 3)
    throw InputError(lines[1].where, fmt::format("corner cuts {} and {}", tilt.first.cut, tilt.second.cut),
                     "cuts that leave at least one cell of the grid: their sum is 3 or more");
  auto table = read_shifts(map, kept_points(tilt), set.filename().string());
  tilt.depths = std::move(table.depths), tilt.shifts = std::move(table.shifts);
  return tilt;
}

}  // namespace floe::ice_files

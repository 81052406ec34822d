#include "propagation/ice/tilt.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/ice/ice_files.h"

namespace floe {

namespace {

Eigen::Vector2d direction_of(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth)};
}

// Where the string at distance 0 stands along the direction of 1D tilt.
double lines_origin(const IceTables& tables, const Detector& detector) {
  const TiltLines& tilt = *tables.tilt_lines;
  const auto zero = std::find(tilt.distances.begin(), tilt.distances.end(), 0.0) - tilt.distances.begin();
  const int string = tilt.strings.at(zero);
  double sum = 0;
  int modules = 0;
  for (const Module& module : detector.modules())
    if (module.id.string == string) {
      sum += module.position.head<2>().dot(direction_of(tilt_lines_direction));
      ++modules;
    }
  if (modules == 0)
    throw InputError({"ice " + tables.name}, fmt::format("a tilt measured from string {}", string),
                     fmt::format("a detector with that string (detector {} has none)", detector.name()),
                     "Name the detector that belongs to the ice, or switch the tilt off");
  return sum / modules;
}

using Polygon = std::vector<Eigen::Vector2d>;

// The part of a convex polygon where inside(point) >= 0, for a linear function `inside`.
template <class Inside>
Polygon clipped(const Polygon& polygon, Inside inside) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double in_a = inside(a), in_b = inside(b);
    if (in_a >= 0) result.push_back(a);
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0))
      result.push_back(a + (b - a) * in_a / (in_a - in_b));
  }
  return result;
}

// The grid's outline in index coordinates (i, j), counterclockwise: a rectangle without its two cut corners.
// Cuts run along the diagonals of cells, so that the outline's corners are grid points.
Polygon outline(const TiltMap& map) {
  const double i = map.first.count - 1, j = map.second.count - 1;
  const Polygon rectangle{{0, 0}, {i, 0}, {i, j}, {0, j}};
  const auto first_cut = [&](const Eigen::Vector2d& p) { return map.first.cut - 1 - p.x() + p.y(); };
  const auto second_cut = [&](const Eigen::Vector2d& p) { return map.second.cut - 1 + p.x() - p.y(); };
  return clipped(clipped(rectangle, first_cut), second_cut);
}

// The shift in a column of depth rows, top first: at row `below` and its change to the row above.
void enter_knot(const std::vector<std::vector<double>>& shifts, int below, int column,
                float* value_and_change) {
  value_and_change[0] = static_cast<float>(shifts[below][column]);
  value_and_change[1] = static_cast<float>(shifts[below - 1][column] - shifts[below][column]);
}

// Which column of shifts belongs to a grid point: [j * count + i], -1 for none. A place on the border may, by
// rounding, seem to lie in the cell beyond: the cut points next to the border repeat the value of the kept
// point reached along the diagonal's normal.
std::vector<int> columns_of(const TiltMap& map) {
  const int width = map.first.count, height = map.second.count;
  std::vector<int> columns(static_cast<std::size_t>(width) * height, -1);
  int column = 0;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      if (ice_files::is_kept(map, i, j)) columns[j * width + i] = column++;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      if (ice_files::is_kept(map, i, j)) continue;
      const bool first_corner = i >= j + map.first.cut;
      const int ni = first_corner ? i - 1 : i, nj = first_corner ? j : j - 1;
      columns[j * width + i] = columns[nj * width + ni];
    }
  return columns;
}

}  // namespace

LayerTilt::LayerTilt(const IceTables& tables, const Detector& detector) {
  if (tables.tilt_map) {
    kind_ = Kind::map;
    set_depths(tables.tilt_map->depths);
    set_grid(*tables.tilt_map);
    set_map_cells(*tables.tilt_map);
  } else if (tables.tilt_lines) {
    kind_ = Kind::lines;
    set_depths(tables.tilt_lines->depths);
    set_line_cells(*tables.tilt_lines);
    const Eigen::Vector2d direction = direction_of(tilt_lines_direction);
    direction_x_ = static_cast<float>(direction.x());
    direction_y_ = static_cast<float>(direction.y());
    origin_ = static_cast<float>(lines_origin(tables, detector));
  }
}

void LayerTilt::set_depths(const std::vector<double>& depths) {
  rows_ = static_cast<int>(depths.size()) - 1;
  z_bottom_ = static_cast<float>(origin_depth - depths.back());
  rows_per_metre_ = static_cast<float>(rows_ / (depths.back() - depths.front()));
}

void LayerTilt::set_line_cells(const TiltLines& lines) {
  distances_.assign(lines.distances.begin(), lines.distances.end());
  cells_ = static_cast<int>(distances_.size()) - 1;
  for (int row = 0; row < rows_; ++row)
    for (int cell = 0; cell < cells_; ++cell) {
      TableRow entry{};
      for (int side = 0; side < 2; ++side)
        enter_knot(lines.shifts, rows_ - row, cell + side, entry.values + 2 * side);
      entry.values[4] = distances_[cell];
      entry.values[5] = static_cast<float>(1 / (lines.distances[cell + 1] - lines.distances[cell]));
      shifts_.push_back(entry);
    }
}

void LayerTilt::set_grid(const TiltMap& map) {
  Eigen::Matrix2d axes;  // columns: unit vectors of the two axes
  axes << direction_of(map.first.direction_deg * degree), direction_of(map.second.direction_deg * degree);
  if (std::abs(axes.determinant()) < 0.01)
    throw InputError("the two axes of the tilt map are parallel; their directions must differ");
  const Eigen::Vector2d start(map.first.start, map.second.start), step(map.first.step, map.second.step);
  const Eigen::Matrix2d to_index = step.cwiseInverse().asDiagonal() * axes.inverse();
  const Eigen::Vector2d offset = -start.cwiseQuotient(step);
  to_index_ = {float(to_index(0, 0)), float(to_index(0, 1)), float(to_index(1, 0)), float(to_index(1, 1))};
  index_offset_ = {float(offset.x()), float(offset.y())};
  count_ = {map.first.count, map.second.count};
  cut_ = {map.first.cut, map.second.cut};

  const Eigen::Matrix2d to_space = axes * step.asDiagonal(), metric = to_space.transpose() * to_space;
  metric_ = {float(metric(0, 0)), float(metric(0, 1)), float(metric(1, 1))};
  const Polygon corners = outline(map);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = corners[i], along = corners[(i + 1) % corners.size()] - a;
    if (along.norm() < 0.5) continue;  // a corner met twice
    // The nearest point to p is a + (p - a).e / e^2 along, for p in index coordinates but dot products in
    // space.
    const Eigen::Vector2d gradient = metric * along / along.dot(metric * along);
    border_.push_back({float(a.x()), float(a.y()), float(along.x()), float(along.y()), float(gradient.x()),
                       float(gradient.y())});
  }
}

void LayerTilt::set_map_cells(const TiltMap& map) {
  const std::vector<int> columns = columns_of(map);
  const int width = map.first.count;
  cells_ = (width - 1) * (map.second.count - 1);
  for (int row = 0; row < rows_; ++row)
    for (int j = 0; j + 1 < map.second.count; ++j)
      for (int i = 0; i + 1 < width; ++i) {
        TableRow entry{};
        for (int corner = 0; corner < 4; ++corner) {
          const int column = columns[(j + corner / 2) * width + i + corner % 2];
          if (column >= 0) enter_knot(map.shifts, rows_ - row, column, entry.values + 2 * corner);
        }
        shifts_.push_back(entry);
      }
}

// The outline is convex: a place outside has its nearest point inside a side when it lies straight out from
// that side, and then from no other; otherwise at a corner. (Comparing distances to sides alone would
// jump near corners, where the distances differ by less than a float can tell.)
void LayerTilt::move_to_border(float& i, float& j) const {
  float nearest = std::numeric_limits<float>::infinity(), corner_i = i, corner_j = j;
  for (const Edge& edge : border_) {
    const float from_i = i - edge.i, from_j = j - edge.j;
    if (edge.along_j * from_i - edge.along_i * from_j <= 0) continue;  // on the inner side
    const float share = from_i * edge.gradient_i + from_j * edge.gradient_j;
    const float clamped = std::clamp(share, 0.0f, 1.0f);
    const float ei = edge.i + clamped * edge.along_i, ej = edge.j + clamped * edge.along_j;
    if (share == clamped) {
      i = ei, j = ej;
      return;
    }
    const float di = i - ei, dj = j - ej;
    const float distance = metric_[0] * di * di + 2 * metric_[1] * di * dj + metric_[2] * dj * dj;
    if (distance < nearest) nearest = distance, corner_i = ei, corner_j = ej;
  }
  i = corner_i, j = corner_j;
}

}  // namespace floe

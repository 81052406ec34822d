#include "geometry/clearance_map.h"

#include <limits>
#include <map>
#include <utility>

#include "data/base/constants.h"
#include "geometry/crossing_order.h"

namespace floe {

namespace {

constexpr float finest_cell = 2;                // [m]
constexpr std::size_t largest_table = 4 << 20;  // [cells]; wider detectors get coarser cells
constexpr float rounding = 5e-3F;               // single precision, 10 km from the origin [m]
// Detectors whose modules hang in more places than this do without the tables along columns.
constexpr std::size_t most_columns = 2000;

// The modules by the place (x, y) where they hang: a vertical string has one.
std::vector<std::vector<Vec3f>> columns_of(const Detector& detector) {
  std::map<std::pair<float, float>, std::vector<Vec3f>> by_place;
  for (const Module& module : detector.modules()) {
    const Vec3f position = module.position.cast<float>();
    by_place[{position.x(), position.y()}].push_back(position);
  }
  std::vector<std::vector<Vec3f>> columns;
  for (auto& [place, modules] : by_place) columns.push_back(std::move(modules));
  return columns;
}

std::size_t cells_over(float length, float cell) {
  return static_cast<std::size_t>(std::ceil(length / cell));
}

}  // namespace

ClearanceMap::ClearanceMap(const Detector& detector, double oversize) {
  check_oversize(oversize);
  const auto extent = detector.extent();
  low_ = extent.low.cast<float>();
  high_ = extent.high.cast<float>();
  reach_ = static_cast<float>(oversize * module_radius) + rounding;
  lay_out_grid();
  const Columns columns = columns_of(detector);
  // With too many columns they share one table without gaps.
  const bool with_gaps = columns.size() <= most_columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    enter_column(with_gaps ? i : 0, columns[i].front().x(), columns[i].front().y());
  enter_gaps(with_gaps ? columns : Columns(1));
}

void ClearanceMap::lay_out_grid() {
  const float width = high_.x() - low_.x() + 2 * farthest, depth = high_.y() - low_.y() + 2 * farthest;
  cell_ = finest_cell;
  while (cells_over(width, cell_) * cells_over(depth, cell_) > largest_table) cell_ *= 2;
  per_cell_ = 1 / cell_;
  columns_ = cells_over(width, cell_);
  rows_ = cells_over(depth, cell_);
  x0_ = low_.x() - farthest;
  y0_ = low_.y() - farthest;
  constexpr auto far = static_cast<std::uint8_t>(farthest / step);
  cells_.assign(columns_ * rows_, {far, far, 0});
}

// Enters a place where modules hang into the cells around it; farther cells keep the largest distance.
void ClearanceMap::enter_column(std::size_t index, float x, float y) {
  const auto first = [&](float low, float start) {
    return static_cast<std::size_t>(std::max(0.0F, (low - farthest - start) * per_cell_));
  };
  const auto end = [&](float high, float start, std::size_t count) {
    return std::min(count, static_cast<std::size_t>((high + farthest - start) * per_cell_) + 1);
  };
  for (std::size_t row = first(y, y0_); row < end(y, y0_, rows_); ++row) {
    const float south = y0_ + static_cast<float>(row) * cell_;
    const float dy = outside(y, south, south + cell_);
    for (std::size_t column = first(x, x0_); column < end(x, x0_, columns_); ++column) {
      const float west = x0_ + static_cast<float>(column) * cell_;
      const float dx = outside(x, west, west + cell_);
      const auto distance =
          static_cast<std::uint8_t>(std::min(std::sqrt(dx * dx + dy * dy), farthest) / step);
      Cell& cell = cells_[row * columns_ + column];
      if (distance < cell.nearest)
        cell = {distance, cell.nearest, static_cast<std::uint16_t>(index)};
      else
        cell.second = std::min(cell.second, distance);
    }
  }
}

// Columns without modules have no gaps: 0 everywhere.
void ClearanceMap::enter_gaps(const Columns& columns) {
  slices_ = static_cast<std::size_t>((high_.z() - low_.z()) / slice) + 1;
  gaps_.assign(columns.size() * slices_, 0);
  for (std::size_t column = 0; column < columns.size(); ++column)
    for (std::size_t i = 0; i < slices_ && !columns[column].empty(); ++i) {
      const float bottom = low_.z() + static_cast<float>(i) * slice;
      float gap = farthest;
      for (const Vec3f& module : columns[column])
        gap = std::min(gap, outside(module.z(), bottom - rounding, bottom + slice + rounding));
      gaps_[column * slices_ + i] = static_cast<std::uint8_t>(gap / step);
    }
}

// Outside the grid no module is nearer than the box that holds them all.
float ClearanceMap::outside_grid(const Vec3f& position) const {
  float square = 0;
  for (int k = 0; k < 3; ++k) {
    const float beyond = outside(position[k], low_[k], high_[k]);
    square += beyond * beyond;
  }
  return std::max(0.0F, std::sqrt(square) - reach_);
}

}  // namespace floe

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "geometry/crossing_order.h"
#include "geometry/module_scene.h"

namespace floe {

namespace {

constexpr float finest_cell = 2;                // [m]
constexpr std::size_t largest_table = 4 << 20;  // [cells]; wider detectors get coarser cells
constexpr float rounding = 5e-3F;               // single precision, 10 km from the origin [m]

// The places (x, y) where modules hang, each once: a vertical string has one.
std::vector<Eigen::Vector2f> columns_of(const Detector& detector) {
  std::vector<Eigen::Vector2f> columns;
  for (const Module& module : detector.modules()) columns.push_back(module.position.head<2>().cast<float>());
  const auto before = [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(columns.begin(), columns.end(), before);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
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
  for (const auto& column : columns_of(detector)) enter_column(column.x(), column.y());
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
  distance_.assign(columns_ * rows_, static_cast<std::uint8_t>(farthest / step));
}

// Lowers the cells around a place where modules hang; farther cells keep the largest distance.
void ClearanceMap::enter_column(float x, float y) {
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
      const float steps = std::min(std::sqrt(dx * dx + dy * dy), farthest) / step;
      auto& cell = distance_[row * columns_ + column];
      cell = std::min(cell, static_cast<std::uint8_t>(steps));
    }
  }
}

}  // namespace floe

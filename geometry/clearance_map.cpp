#include "geometry/clearance_map.h"

#include <algorithm>

#include "data/base/constants.h"
#include "geometry/crossing_order.h"

namespace floe {

namespace {

constexpr float finest_cell = 2;                // [m]
constexpr std::size_t largest_table = 4 << 20;  // [cells]; wider detectors get coarser cells
constexpr float rounding = 5e-3F;               // single precision, 10 km from the origin [m]
// Detectors whose modules hang in more columns do without the tables along them.
constexpr std::size_t most_columns = 2000;

std::size_t cells_over(float length, float cell) {
  return static_cast<std::size_t>(std::ceil(length / cell));
}

// An entry of the grid.
std::uint32_t packed(std::uint32_t nearest, std::uint32_t second, std::uint32_t column) {
  return nearest | second << 8 | column << 16;
}

float outside(float x, float low, float high) {
  return std::max({low - x, x - high, 0.0F});
}

}  // namespace

ClearanceMap::ClearanceMap(const Detector& detector, double oversize) {
  check_oversize(oversize);
  const auto extent = detector.extent();
  const Vec3f low = extent.low.cast<float>(), high = extent.high.cast<float>();
  view_.low_x = low.x(), view_.low_y = low.y(), view_.low_z = low.z();
  view_.high_x = high.x(), view_.high_y = high.y(), view_.high_z = high.z();
  view_.reach_ = static_cast<float>(oversize * module_radius) + rounding;
  lay_out_grid();
  const std::vector<ModuleColumn> columns = columns_of(detector);
  const bool with_slices = columns.size() <= most_columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    enter_column(with_slices ? static_cast<std::uint32_t>(i) : 0, columns[i]);
  if (!with_slices)  // all columns are as one, in which a module is everywhere and others are, too
    for (std::uint32_t& cell : cells_) cell = packed(cell & 255, cell & 255, 0);
  enter_slices(with_slices ? columns : std::vector<ModuleColumn>(1));
  view_.cells = cells_.data();
  view_.slices = slices_.data();
}

void ClearanceMap::lay_out_grid() {
  const float width = view_.high_x - view_.low_x + 2 * farthest,
              depth = view_.high_y - view_.low_y + 2 * farthest;
  cell_ = finest_cell;
  while (cells_over(width, cell_) * cells_over(depth, cell_) > largest_table) cell_ *= 2;
  const std::size_t columns = cells_over(width, cell_), rows = cells_over(depth, cell_);
  view_.per_cell = 1 / cell_;
  view_.columns = static_cast<std::int32_t>(columns);
  // A place beyond the last cell's far end, by rounding too, counts as outside.
  view_.last_column = static_cast<float>(columns) - 0.01F;
  view_.last_row = static_cast<float>(rows) - 0.01F;
  view_.x0 = view_.low_x - farthest;
  view_.y0 = view_.low_y - farthest;
  constexpr auto far = static_cast<std::uint32_t>(farthest / step);
  cells_.assign(columns * rows, packed(far, far, 0));
}

// Enters a column into the cells around it; farther cells keep the largest distance.
void ClearanceMap::enter_column(std::uint32_t index, const ModuleColumn& entered) {
  const auto columns = static_cast<std::size_t>(view_.columns), rows = cells_.size() / columns;
  const float range = farthest + entered.radius;
  const auto first = [&](float place, float start) {
    return static_cast<std::size_t>(std::max(0.0F, (place - range - start) * view_.per_cell));
  };
  const auto end = [&](float place, float start, std::size_t count) {
    return std::min(count, static_cast<std::size_t>((place + range - start) * view_.per_cell) + 1);
  };
  for (std::size_t row = first(entered.y, view_.y0); row < end(entered.y, view_.y0, rows); ++row) {
    const float south = view_.y0 + static_cast<float>(row) * cell_;
    const float dy = outside(entered.y, south, south + cell_);
    for (std::size_t column = first(entered.x, view_.x0); column < end(entered.x, view_.x0, columns);
         ++column) {
      const float west = view_.x0 + static_cast<float>(column) * cell_;
      const float dx = outside(entered.x, west, west + cell_);
      const float aside = std::max(std::sqrt(dx * dx + dy * dy) - entered.radius, 0.0F);
      const auto distance = static_cast<std::uint32_t>(std::min(aside, farthest) / step);
      std::uint32_t& cell = cells_[row * columns + column];
      const std::uint32_t nearest = cell & 255, second = (cell >> 8) & 255;
      cell = distance < nearest ? packed(distance, nearest, index)
                                : packed(nearest, std::min(second, distance), cell >> 16);
    }
  }
}

void ClearanceMap::enter_slices(const std::vector<ModuleColumn>& columns) {
  const auto count = static_cast<std::size_t>((view_.high_z - view_.low_z) / slice) + 1;
  view_.slice_count = static_cast<std::int32_t>(count);
  view_.per_slice = 1 / slice;
  view_.last_slice = static_cast<float>(count) - 0.01F;
  slices_.assign(columns.size() * count, 0);
  for (std::size_t column = 0; column < columns.size(); ++column)
    for (std::size_t i = 0; i < count && !columns[column].modules.empty(); ++i) {
      const float bottom = view_.low_z + static_cast<float>(i) * slice;
      const auto gap = [&](const std::pair<float, std::uint32_t>& module) {
        return outside(module.first, bottom - rounding, bottom + slice + rounding);
      };
      const auto nearest = std::min_element(columns[column].modules.begin(), columns[column].modules.end(),
                                            [&](const auto& a, const auto& b) { return gap(a) < gap(b); });
      const auto steps = static_cast<std::uint32_t>(std::min(gap(*nearest), farthest) / step);
      slices_[column * count + i] = steps | nearest->second << 8;
    }
}

}  // namespace floe

// How far a photon may walk before the geometry matters again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/detector.h"

namespace floe {

// A lower bound of the distance [m] a photon may walk from a point, in any direction and through any
// number of scatters, before it can meet any widened module: tabulated, never larger than the truth, 0
// near modules. A widened module of oversize X is met within X module radii of its centre.
//
// Modules hang in vertical columns. A horizontal grid knows for each cell the nearest column, how far it is
// at least, and how far the second nearest is; a table along the nearest column knows how far above or
// below its nearest module is. So a photon beside a string, between two modules, is still free to walk.
class ClearanceMap {
 public:
  // Throws UsageError unless 1 <= oversize <= 100.
  ClearanceMap(const Detector& detector, double oversize);

  float operator()(const Vec3f& position) const {
    const float column = (position.x() - x0_) * per_cell_, row = (position.y() - y0_) * per_cell_;
    if (!(column >= 0 && row >= 0 && column < static_cast<float>(columns_) &&
          row < static_cast<float>(rows_)))
      return outside_grid(position);
    const Cell& cell = cells_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
    const float beyond = outside(position.z(), low_.z(), high_.z());
    const float gap = beyond + vertical_gap(cell.column, position.z());
    const float to_nearest = step * cell.nearest, to_second = step * cell.second;
    const float square =
        std::min(to_nearest * to_nearest + gap * gap, to_second * to_second + beyond * beyond);
    return std::max(0.0F, std::sqrt(square) - reach_);
  }

 private:
  static constexpr float step = 0.25F;       // of the tabulated distances [m]
  static constexpr float farthest = 63.75F;  // tabulated [m]
  static constexpr float slice = 1;          // of the tables along columns [m]

  struct Cell {
    std::uint8_t nearest,
        second;            // distances of columns from the cell's nearest point, in steps, rounded down
    std::uint16_t column;  // the nearest
  };

  // Distance of a coordinate to an interval.
  static float outside(float x, float low, float high) { return std::max({low - x, x - high, 0.0F}); }

  // Lower bound of the height from a point, moved between the highest and the lowest module of all, to
  // the nearest module of a column.
  float vertical_gap(std::size_t column, float z) const {
    const float place = (std::clamp(z, low_.z(), high_.z()) - low_.z()) / slice;
    return step * gaps_[column * slices_ + static_cast<std::size_t>(place)];
  }
  float outside_grid(const Vec3f& position) const;

  using Columns = std::vector<std::vector<Vec3f>>;  // modules at the same (x, y)
  void lay_out_grid();
  void enter_column(std::size_t index, float x, float y);
  void enter_gaps(const Columns& columns);

  std::vector<Cell> cells_;  // by row
  std::size_t columns_ = 0, rows_ = 0;
  float x0_ = 0, y0_ = 0, cell_ = 0, per_cell_ = 0;
  std::vector<std::uint8_t> gaps_;  // in steps, rounded down: [column * slices + slice]
  std::size_t slices_ = 0;
  Vec3f low_, high_;  // extent of the modules' centres
  float reach_ = 0;   // of a widened module, and what rounding may cost [m]
};

}  // namespace floe

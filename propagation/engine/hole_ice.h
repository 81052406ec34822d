// The refrozen drill holes: vertical columns of ice of their own around the strings (arXiv:2107.10435).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "propagation/engine/vector_math.h"
#include "propagation/model.h"

namespace floe {

// A straight path through a column: distances along the path, from its start [m].
struct ColumnPassage {
  double entry;  // 0: the path starts inside
  double exit;   // > entry; HoleIceColumns::endless for a vertical path
};

// One infinitely tall cylinder around the centre of each drill hole, of the radius and ice that cfg.txt
// names. Inside it neither layers nor anisotropies nor crystals matter. Immutable.
//
// Positions are rounded, so that a path that ended on a column's surface may start a little inside or
// outside of it. A column is met when more than `tolerance` of horizontal path through it lies ahead, and
// a path starts inside when its entry is less than that ahead: whoever has just left a column does not meet
// it again, and whoever has just reached it is inside. So paths from surface to surface always advance.
class HoleIceColumns {
 public:
  static constexpr double tolerance = 1e-4;  // [m]; above the rounding of floats within 1 km
  static constexpr double endless = 1e9;     // [m]

  explicit HoleIceColumns(const Model& model);

  bool exist() const { return radius_ > 0; }  // false: the ice model has no columns, nothing is ever met
  double radius() const { return radius_; }   // [m]
  // Of the columns' ice, the same at all wavelengths [1/m]; geometric scattering is effective / (1 - g).
  double geometric_scattering() const { return geometric_scattering_; }
  double absorption() const { return absorption_; }
  double simplified_liu_fraction() const { return simplified_liu_fraction_; }
  double mean_cosine() const { return mean_cosine_; }

  // The column that a path of a length [m] along a unit vector meets first; where columns overlap at its
  // start, the one that it leaves last.
  std::optional<ColumnPassage> first(const Vec3& origin, const Vec3& direction, double length) const;

  // A path from here that is shorter than this meets no column [m]; a lower bound, 0 inside.
  float free(float x, float y) const {
    const float beyond_x = outside(x, low_x_, high_x_), beyond_y = outside(y, low_y_, high_y_);
    const Cell& cell = cell_near(x, y);
    const float dx = x - cell.x, dy = y - cell.y;
    const float near = smaller(std::sqrt(dx * dx + dy * dy), cell.others);
    const float box = std::sqrt(beyond_x * beyond_x + beyond_y * beyond_y);
    return larger(0, larger(near_the_grid(x, y) ? near : 0, box) - reach_);
  }

 private:
  // A cell of a horizontal grid: the axis that is nearest to its centre, and how far from any of its points
  // the other axes are at least.
  struct Cell {
    float x, y, others;
    std::int32_t axis;  // its index
  };
  struct Axis {
    double x, y;
  };

  void lay_out_grid();
  Cell make_cell(double x, double y) const;
  bool passage(const Axis& axis, const Vec3& origin, const Vec3& direction, double length,
               ColumnPassage& passage) const;

  static float outside(float a, float low, float high) { return larger(0, larger(low - a, a - high)); }
  float cell_number(float a, float low) const { return (a - low) * cells_per_metre_ + 1; }
  bool near_the_grid(float x, float y) const {
    const float column = cell_number(x, low_x_), row = cell_number(y, low_y_);
    return column >= 0 && column < static_cast<float>(columns_) && row >= 0 &&
           row < static_cast<float>(rows_);
  }
  const Cell& cell_near(float x, float y) const {
    const auto place = [](float number, std::int32_t count) {
      return static_cast<std::int32_t>(smaller(larger(number, 0), static_cast<float>(count - 1)));
    };
    return cells_[place(cell_number(y, low_y_), rows_) * columns_ + place(cell_number(x, low_x_), columns_)];
  }

  double radius_ = 0, geometric_scattering_ = 0, absorption_ = 0;
  double simplified_liu_fraction_ = 0, mean_cosine_ = 0;
  std::vector<Axis> axes_;
  std::vector<Cell> cells_;  // by row; one cell beyond the axes' extent on every side
  std::int32_t columns_ = 0, rows_ = 0;
  float low_x_ = 0, low_y_ = 0, high_x_ = 0, high_y_ = 0;  // extent of the axes
  float cells_per_metre_ = 1;
  float reach_ = 0;  // the radius, and what rounding may cost [m]
};

}  // namespace floe

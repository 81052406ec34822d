// Ice layers are not flat: a photon at (x, y, z) is in the layer of height z - shift(x, y, z).
#pragma once

#include <array>
#include <vector>

#include "geometry/detector.h"
#include "propagation/ice/ice_tables.h"

namespace floe {

// The layer shift [m] as a function of place [m]; none, 1D along 225 deg, or 2D on an oblique grid
// (arXiv:2307.13951), which takes precedence. Depth and, in 1D, distance are extrapolated linearly; in 2D a place
// outside the grid has the value of the nearest place on its border.
class LayerTilt {
 public:
  LayerTilt() = default;  // flat layers
  // The 1D origin is the mean position along 225 deg of the string whose distance is 0.
  LayerTilt(const IceTables& tables, const Detector& detector);

  bool is_flat() const { return kind_ == Kind::flat; }
  float shift(float x, float y, float z) const;

 private:
  enum class Kind { flat, lines, map };
  struct Knot { float value, slope; };  // at a depth row's lower end, and its change per row upwards

  float lines_shift(float x, float y, float z) const;
  float map_shift(float x, float y, float z) const;
  Knot knot(int column, int row) const { return knots_[row * columns_ + column]; }

  Kind kind_ = Kind::flat;
  int rows_ = 0, columns_ = 0;          // rows: intervals of depth, bottom first
  float z_bottom_ = 0, rows_per_metre_ = 0;
  std::vector<Knot> knots_;

  // 1D
  float direction_x_ = 0, direction_y_ = 0, origin_ = 0;
  std::vector<float> distances_;

  // 2D
  std::array<float, 4> to_grid_{};      // (x, y) -> oblique coordinates along the two axes
  std::array<float, 2> start_{}, step_{};
  std::array<int, 2> count_{}, cut_{};
  std::vector<int> column_of_;          // [j * count0 + i]; -1 where there is no grid point
};

}  // namespace floe

// Ice layers are not flat: a photon at (x, y, z) is in the layer of height z - shift(x, y, z).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "geometry/detector.h"
#include "propagation/engine/table_rows.h"
#include "propagation/ice/ice_tables.h"

namespace floe {

inline constexpr double tilt_lines_direction = 225 * degree;  // azimuth along which 1D tilt varies
// From the frame's origin [m].
inline double distance_along_tilt(const Vec3& place) {
  return place.x() * std::cos(tilt_lines_direction) + place.y() * std::sin(tilt_lines_direction);
}

// The layer shift [m] as a function of place [m]; none, 1D along 225 deg, or 2D on an oblique grid
// (arXiv:2307.13951), which takes precedence. Depth and, in 1D, distance are extrapolated linearly; in 2D a
// place outside the grid has the value of the nearest place on its border.
class LayerTilt {
 public:
  LayerTilt() = default;  // flat layers
  // The 1D origin is the mean position along 225 deg of the string whose distance is 0.
  LayerTilt(const IceTables& tables, const Detector& detector);

  bool is_flat() const { return kind_ == Kind::flat; }
  float shift(float x, float y, float z) const {
    float result;
    shifts(&x, &y, &z, &result, 1);
    return result;
  }
  // Of `count` places at once; vector code.
  void shifts(const float* x, const float* y, const float* z, float* shift, int count) const;

 private:
  enum class Kind { flat, lines, map };
  // A side of the grid's outline (counterclockwise), in index coordinates; `gradient` gives the share of the
  // side at which the nearest point to a place lies.
  struct Edge {
    float i, j, along_i, along_j, gradient_i, gradient_j;
  };

  void set_depths(const std::vector<double>& depths);
  void set_line_cells(const TiltLines& lines);
  void set_grid(const TiltMap& map);
  void set_map_cells(const TiltMap& map);

  static constexpr int block = 64;  // places that are looked up together
  void lines_shifts(const float* x, const float* y, const float* z, float* shift, int count) const;
  void map_shifts(const float* x, const float* y, const float* z, float* shift, int count) const;
  void move_to_border(float& i, float& j) const;

  Kind kind_ = Kind::flat;
  int rows_ = 0, cells_ = 0;  // rows: intervals of depth, bottom first; cells in each
  float z_bottom_ = 0, rows_per_metre_ = 0;
  // A cell's shifts at the row's lower end and their changes to its upper end: [row * cells + cell].
  // 1D: left value, change, right value, change, distance of the left end, 1/width.
  // 2D: value and change at the corners (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1).
  std::vector<TableRow> shifts_;

  // 1D
  float direction_x_ = 0, direction_y_ = 0, origin_ = 0;
  std::vector<float> distances_;

  // 2D; index coordinates (i, j) count steps along the two axes from the first grid point
  std::array<float, 4> to_index_{};  // matrix (x, y) -> (i, j)
  std::array<float, 2> index_offset_{};
  std::array<float, 3> metric_{};  // squared distance in space = m0 di^2 + 2 m1 di dj + m2 dj^2
  std::array<int, 2> count_{}, cut_{};
  std::vector<Edge> border_;
};

}  // namespace floe

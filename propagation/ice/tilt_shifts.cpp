// The look-up of layer shifts. Compiled with fast-math: places are finite. Loops over places become vector
// code, which needs plain pointers, values instead of references, and no branches.
#include <algorithm>

#include "propagation/ice/tilt.h"

namespace floe {

namespace {

inline float limited(float x, float low, float high) {
  const float above = x > low ? x : low;
  return above < high ? above : high;
}

}  // namespace

void LayerTilt::shifts(const float* x, const float* y, const float* z, float* shift, int count) const {
  for (int first = 0; first < count; first += block) {
    const int size = std::min(block, count - first);
    if (kind_ == Kind::lines)
      lines_shifts(x + first, y + first, z + first, shift + first, size);
    else if (kind_ == Kind::map)
      map_shifts(x + first, y + first, z + first, shift + first, size);
    else
      std::fill_n(shift + first, size, 0.0f);
  }
}

void LayerTilt::lines_shifts(const float* x, const float* y, const float* z, float* shift, int count) const {
  const float direction_x = direction_x_, direction_y = direction_y_, origin = origin_;
  float distance[block];
  int right[block];  // the column to the right of the place, counted rather than searched for
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    distance[i] = direction_x * x[i] + direction_y * y[i] - origin;
    right[i] = 1;
  }
  for (int column = 1; column + 1 < columns_; ++column) {
    const float start = distances_[column];
#pragma omp simd
    for (int i = 0; i < count; ++i) right[i] += distance[i] >= start ? 1 : 0;
  }
  const float bottom = z_bottom_, per_metre = rows_per_metre_, last_row = static_cast<float>(rows_ - 1);
  const float *distances = distances_.data(), *values = values_.data(), *slopes = slopes_.data();
  const int columns = columns_;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    // Beyond the ends the outermost rows continue.
    const float height = (z[i] - bottom) * per_metre;
    const int row = static_cast<int>(limited(height, 0, last_row));
    const float above = height - static_cast<float>(row);
    const int right_knot = row * columns + right[i], left_knot = right_knot - 1, left = right[i] - 1;
    const float at_left = values[left_knot] + slopes[left_knot] * above;
    const float at_right = values[right_knot] + slopes[right_knot] * above;
    const float share = (distance[i] - distances[left]) / (distances[right[i]] - distances[left]);
    shift[i] = at_left + share * (at_right - at_left);
  }
}

void LayerTilt::map_shifts(const float* x, const float* y, const float* z, float* shift, int count) const {
  const auto [xi, yi, xj, yj] = to_index_;
  const auto [offset_i, offset_j] = index_offset_;
  const float last_i = static_cast<float>(count_[0] - 1), last_j = static_cast<float>(count_[1] - 1);
  const float cut_i = static_cast<float>(cut_[0] - 1), cut_j = static_cast<float>(cut_[1] - 1);
  float index_i[block], index_j[block];
  int outside[block];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const float i = xi * x[k] + yi * y[k] + offset_i, j = xj * x[k] + yj * y[k] + offset_j;
    index_i[k] = i;
    index_j[k] = j;
    const float excess_i = std::max(-i, i - last_i), excess_j = std::max(-j, j - last_j);
    const float excess_cut = std::max(i - j - cut_i, j - i - cut_j);
    outside[k] = std::max(std::max(excess_i, excess_j), excess_cut) > 0 ? 1 : 0;
  }
  for (int k = 0; k < count; ++k)
    if (outside[k]) move_to_border(index_i[k], index_j[k]);

  const float bottom = z_bottom_, per_metre = rows_per_metre_, last_row = static_cast<float>(rows_ - 1);
  const float *values = values_.data(), *slopes = slopes_.data();
  const int* column_of = column_of_.data();
  const int columns = columns_, width = count_[0];
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const int cell_i = static_cast<int>(limited(index_i[k], 0, last_i - 1));
    const int cell_j = static_cast<int>(limited(index_j[k], 0, last_j - 1));
    const float u = index_i[k] - static_cast<float>(cell_i), v = index_j[k] - static_cast<float>(cell_j);
    const float larger = u > v ? u : v, smaller = u > v ? v : u;
    // The diagonal splits the cell: below it (u > v) the third corner is (i+1, j), above it (i, j+1).
    const int corner = cell_j * width + cell_i, step = u > v ? 1 : width;
    const float height = (z[k] - bottom) * per_metre;
    const int row = static_cast<int>(limited(height, 0, last_row));
    const float above = height - static_cast<float>(row);
    const int knots = row * columns;
    const int third_corner = corner + step, far_corner = corner + width + 1;
    const int a = knots + column_of[corner], b = knots + column_of[third_corner],
              c = knots + column_of[far_corner];
    shift[k] = (1 - larger) * (values[a] + slopes[a] * above) +
               (larger - smaller) * (values[b] + slopes[b] * above) +
               smaller * (values[c] + slopes[c] * above);
  }
}

}  // namespace floe

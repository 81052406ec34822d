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
  alignas(64) float distance[block], above[block];
  alignas(64) int cell[block] = {};  // the interval of distances, counted rather than searched for
#pragma omp simd
  for (int i = 0; i < count; ++i) distance[i] = direction_x * x[i] + direction_y * y[i] - origin;
  for (int inner = 1; inner < cells_; ++inner) {
    const float start = distances_[inner];
#pragma omp simd
    for (int i = 0; i < count; ++i) cell[i] += distance[i] >= start ? 1 : 0;
  }
  const float bottom = z_bottom_, per_metre = rows_per_metre_, last_row = static_cast<float>(rows_ - 1);
  const int cells = cells_;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    // Beyond the ends the outermost rows continue.
    const float height = (z[i] - bottom) * per_metre;
    const int row = static_cast<int>(limited(height, 0, last_row));
    above[i] = height - static_cast<float>(row);
    cell[i] += row * cells;
  }
  alignas(64) float at[8][block];
  fetch_rows(shifts_.data(), cell, at);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float left = at[0][i] + at[1][i] * above[i], right = at[2][i] + at[3][i] * above[i];
    const float share = (distance[i] - at[4][i]) * at[5][i];
    shift[i] = left + share * (right - left);
  }
}

void LayerTilt::map_shifts(const float* x, const float* y, const float* z, float* shift, int count) const {
  const auto [xi, yi, xj, yj] = to_index_;
  const auto [offset_i, offset_j] = index_offset_;
  const float last_i = static_cast<float>(count_[0] - 1), last_j = static_cast<float>(count_[1] - 1);
  const float cut_i = static_cast<float>(cut_[0] - 1), cut_j = static_cast<float>(cut_[1] - 1);
  alignas(64) float index_i[block], index_j[block], above[block];
  int any_outside = 0;
  alignas(64) int outside[block];
#pragma omp simd reduction(| : any_outside)
  for (int k = 0; k < count; ++k) {
    const float i = xi * x[k] + yi * y[k] + offset_i, j = xj * x[k] + yj * y[k] + offset_j;
    index_i[k] = i;
    index_j[k] = j;
    const float excess_i = std::max(-i, i - last_i), excess_j = std::max(-j, j - last_j);
    const float excess_cut = std::max(i - j - cut_i, j - i - cut_j);
    outside[k] = std::max(std::max(excess_i, excess_j), excess_cut) > 0 ? 1 : 0;
    any_outside |= outside[k];
  }
  for (int k = 0; any_outside != 0 && k < count; ++k)
    if (outside[k]) move_to_border(index_i[k], index_j[k]);

  const float bottom = z_bottom_, per_metre = rows_per_metre_, last_row = static_cast<float>(rows_ - 1);
  const int cells = cells_, cells_wide = count_[0] - 1;
  alignas(64) int cell[block] = {};
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const int cell_i = static_cast<int>(limited(index_i[k], 0, last_i - 1));
    const int cell_j = static_cast<int>(limited(index_j[k], 0, last_j - 1));
    index_i[k] -= static_cast<float>(cell_i);
    index_j[k] -= static_cast<float>(cell_j);
    const float height = (z[k] - bottom) * per_metre;
    const int row = static_cast<int>(limited(height, 0, last_row));
    above[k] = height - static_cast<float>(row);
    cell[k] = row * cells + cell_j * cells_wide + cell_i;
  }
  alignas(64) float at[8][block];
  fetch_rows(shifts_.data(), cell, at);
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    const float u = index_i[k], v = index_j[k];
    const float larger = u > v ? u : v, smaller = u > v ? v : u;
    // The diagonal splits the cell: below it (u > v) the third corner is (i+1, j), above it (i, j+1).
    const float below_diagonal = at[2][k] + at[3][k] * above[k],
                above_diagonal = at[4][k] + at[5][k] * above[k];
    const float third = u > v ? below_diagonal : above_diagonal;
    shift[k] = (1 - larger) * (at[0][k] + at[1][k] * above[k]) + (larger - smaller) * third +
               smaller * (at[6][k] + at[7][k] * above[k]);
  }
}

}  // namespace floe

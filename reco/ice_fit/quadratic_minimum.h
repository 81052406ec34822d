// The minimum of -ln L between the points of a grid.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "reco/figures/contours.h"

namespace floe {

struct QuadraticMinimum {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  // Whether the fitted surface has a minimum within the grid. Otherwise place and value are the lowest
  // point's, and errors are not known.
  bool found = false;
  bool at_edge = false;  // the lowest point is one of the outermost, or the fitted minimum lies beyond them
  double x = unknown, y = unknown, value = unknown;
  double x_error = unknown, y_error = unknown;  // where -ln L, minimised over the other number, is 1/2 higher
  double correlation = unknown;
  std::vector<std::size_t> points;  // of the grid, that were fitted
};

// Least squares of a polynomial of second degree (6 coefficients) to the lowest points, nine at least, with
// errors in proportion to `noise` + their height above the lowest: far from the minimum -ln L is no parabola.
// Points are taken up to a few times the noise, which counts as 1 when it is less.
// `values`: rows along rising ys, columns along rising xs, evenly spaced, 3 each at least; NaN: not known.
QuadraticMinimum quadratic_minimum(const std::vector<double>& xs, const std::vector<double>& ys,
                                   const NumberGrid& values, double noise = 1);

}  // namespace floe

// The median error that a study would show if every event's errors were Gaussian, as large as its bound says.
#pragma once

#include <Eigen/Core>
#include <span>

namespace floe {

// Events differ: many of them have small errors and some large ones, so that the median of all errors is not
// the median of what each event would have for its own.
struct DrawnMedian {
  double value = 0;    // mean over many studies of as many events
  double scatter = 0;  // of one study about it
};

// Of the lengths of Gaussian vectors (or of absolute values, with 1 x 1), an event each with its own
// covariance; drawn with a fixed seed, so that value and scatter are good to 1% and 2%. Not a number for no
// events.
DrawnMedian median_of_gaussian_lengths(std::span<const Eigen::MatrixXd> covariances);

}  // namespace floe

// The diffusion pattern: where photons of one first direction end after many crossings, in numbers.
//
// A photon's deflection is a point (x, y) of the plane across its first direction, x towards the nearer flow
// direction, at the distance of the angle theta between first and last direction. (Propagation turns photons
// with p = 2 tan(theta/2) instead, engine/birefringence.h: the same to 0.1% in the core, but without bound
// where one photon comes back.) Patterns have a core and tails: a photon that meets a boundary at a grazing
// angle may be reflected, and one such event turns it more than all others do. "All" and "core" estimators
// differ, and are told apart here.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "propagation/crystal/walk.h"

namespace floe {

enum class PatternNumber {
  mean_x,
  mean_y,  // of all photons [rad]
  core_mean_x,
  core_mean_y,  // of the photons of the core [rad]
  median_x,     // [rad]
  sigma_x,
  sigma_y,  // root of the variance of all photons [rad]
  core_sigma_x,
  core_sigma_y,     // half the distance of the quantiles 15.87% and 84.13% [rad]
  skewness_x,       // of all photons
  core_skewness_x,  // (q84 + q16 - 2 median)/(q84 - q16)
  kurtosis_x,
  kurtosis_y,      // of all photons, 0 of a Gaussian
  tail_share,      // photons outside the core, 0.5% of a Gaussian
  backward_share,  // photons that travel backwards
  correlation_xy,  // of the core's photons
  shift_x,
  shift_y,  // mean displacement over the path's length
  shift_slope_x,
  shift_slope_y,  // slope of displacement on deflection, over half the path's length
  shift_variance_x,
  shift_variance_y,  // variance around that line, over (core's variance) L^2/12
  count
};
inline constexpr std::size_t pattern_numbers = static_cast<std::size_t>(PatternNumber::count);
// As files call them.
std::string_view name_of(PatternNumber number);

struct Estimate {
  double value = 0, error = 0;
};

inline constexpr std::size_t fewest_pattern_photons = 200;

// Errors are those of 20 portions of the photons: the spread of their values over the square root of 20.
// The core: photons within 3 core widths of the median, in x and in y; displacements are told of it.
class PatternStatistics {
 public:
  // `length`: of each photon's path [m]. Throws UsageError with fewer than fewest_pattern_photons.
  PatternStatistics(std::span<const WalkedPhoton> photons, double length);
  const Estimate& operator[](PatternNumber number) const {
    return estimates_[static_cast<std::size_t>(number)];
  }

 private:
  std::array<Estimate, pattern_numbers> estimates_;
};

}  // namespace floe

// From diffusion patterns to the 12 numbers of the two functions that propagation takes (arXiv:2107.08692):
//   sigma_x, sigma_y = A exp(-B [atan(D sin eta)]^C),
//   m_x = A atan(D sin eta cos eta) exp(-B sin eta + C cos eta),
// for a path of 1000 grains, which is 1 m of ice at strength 1.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "propagation/crystal/pattern_grid.h"
#include "propagation/ice/ice_model.h"

namespace floe {

// A value of a pattern at an angle to the flow.
struct AngleValue {
  double angle;  // [rad]
  double value, error;
};

struct FunctionFit {
  DiffusionFunction numbers, errors;
  // Where D is small, atan(D s) is D s, and only B D^C (sigma) or A D (mean) follow from the points. D is
  // then held at the lower end of its range, and its error is 0.
  bool D_held = false;
  double chi_square = 0;
  int degrees_of_freedom = 0;
  double worst = 0;  // largest distance of a point from the curve, in units of the largest value
};

// C of widths is sought in [0.5, 6], B and C of the deflection in [-6, 6]: where there is next to nothing to
// describe, as in spheres without fabric, the points tell no exponent, and huge ones that cancel would do.
// Least squares with Ceres, of points whose error is above 0. Errors of the numbers are those of the points'
// errors, whatever chi-square is. Throws NoResult with fewer than 5 such points, or without convergence.
FunctionFit fit_sigma(std::span<const AngleValue> points);
FunctionFit fit_mean(std::span<const AngleValue> points);

// How widths and deflection are read off a pattern.
enum class PatternEstimator {
  core,  // core_sigma_x, core_sigma_y, core_mean_x
  all    // sigma_x, sigma_y, mean_x
};

struct DiffusionFit {
  std::array<std::vector<AngleValue>, 3> points;  // sigma_x, sigma_y, m_x of 1000 grains
  std::array<FunctionFit, 3> functions;
  BirefringenceNumbers numbers() const;
};
inline constexpr std::array<std::string_view, 3> diffusion_names{"sigma_x", "sigma_y", "m_x"};

// `grain`: the mean distance between crossings that strength 1 makes 1 mm of (PatternGrid::grain) [m].
// Patterns of other lengths than 1000 grains are scaled, widths with the root of the length, deflections
// linearly.
DiffusionFit fit_diffusion(std::span<const CrystalPattern> patterns, double grain,
                           PatternEstimator estimator);

}  // namespace floe

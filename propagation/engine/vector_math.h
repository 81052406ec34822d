// Small functions in a form that compilers turn into vector code: by value, without branches.
#pragma once

#include <cmath>

#include "data/base/vec3.h"

namespace floe {

// std::min and std::max take references, which keeps g++ 12 from vectorising a loop.
inline float smaller(float a, float b) {
  return a < b ? a : b;
}
inline float larger(float a, float b) {
  return a < b ? b : a;
}

// Sine and cosine of a fraction of a turn. (g++ merges sinf and cosf of one argument into a call that has
// no vector form.)
template <typename Scalar>
struct TurnFunctions {
  Scalar sine, cosine;
};
inline TurnFunctions<double> turn_functions(double turn) {
  return {std::sin(2 * pi * turn), std::cos(2 * pi * turn)};
}

// sin(2 pi u) and cos(2 pi u) for u in [0, 1], absolute error below 2e-7. With a = u - 1/2 and
// b = |a| - 1/4 both follow from polynomials on |b| <= 1/4 (least squares on Chebyshev points).
inline TurnFunctions<float> turn_functions(float u) {
  const float a = u - 0.5f;
  const float b = std::fabs(a) - 0.25f;
  const float q = b * b;
  const float sin_b =
      b * (6.2831851596f +
           q * (-41.3416549293f + q * (81.6009981926f + q * (-76.5496568205f + q * 39.5358137107f))));
  const float cos_b =
      0.9999999998f +
      q * (-19.7392085483f +
           q * (64.9393465529f + q * (-85.4535681948f + q * (60.1439523303f + q * -24.9818360971f))));
  // sin(2 pi u) = -sin(2 pi a) = -sign(a) cos(2 pi b); cos(2 pi u) = -cos(2 pi a) = sin(2 pi b).
  return {-std::copysign(cos_b, a), sin_b};
}

}  // namespace floe

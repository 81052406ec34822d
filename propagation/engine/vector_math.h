// Small functions in a form that compilers turn into vector code: by value, without branches.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

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

// sin(2 pi u) and cos(2 pi u) for u in [0, 1], absolute error below 2.5e-7. With a = u - 1/2 and
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

// Logarithm of a positive normal number, relative error below 2e-7. With x = m 2^e, m in [sqrt(1/2),
// sqrt(2)), and f = m - 1, (ln(1 + f) - f)/f^2 is a polynomial (least squares on Chebyshev points, weights
// towards equal errors). Vector code without calls, unlike the library's.
inline double natural_log(double x) {
  return std::log(x);
}
inline float natural_log(float x) {
  constexpr std::int32_t sqrt_half = 0x3f3504f3;
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - sqrt_half) >> 23;
  const float f = std::bit_cast<float>(bits - (exponent << 23)) - 1;
  const float p =
      -0.4999999588f +
      f * (0.333336661f +
           f * (-0.2500139585f +
                f * (0.1997255313f +
                     f * (-0.1658125313f + f * (0.1482031489f + f * (-0.142126426f + f * 0.08901777036f))))));
  return static_cast<float>(exponent) * 0.69314718056f + (f + f * f * p);
}

// exp(x) for x in [-80, 0], relative error below 2e-7 + 8e-8 |x|, of which the second part is the rounding
// of x to a power of two: 2^k 2^f with k whole and |f| <= 1/2, where (2^f - 1)/f is a polynomial (found as
// above).
inline double decay(double x) {
  return std::exp(x);
}
inline float decay(float x) {
  const float power = x * 1.44269504089f;
  const auto whole = static_cast<std::int32_t>(power - 0.5f);
  const float f = power - static_cast<float>(whole);
  const float p =
      0.6931471879f +
      f * (0.2402264979f +
           f * (0.05550357434f + f * (0.009618237515f + f * (0.001339073545f + f * 0.0001540350603f))));
  return std::bit_cast<float>((whole + 127) << 23) * (1 + f * p);
}

}  // namespace floe

// The two functions of arXiv:2107.08692 for what 1 m of ice at strength 1 does to light at the angle eta to
// the flow. Written once for numbers and for what fits differentiate.
#pragma once

#include <cmath>

namespace floe {

// sigma_x, sigma_y [rad]: A exp(-B [atan(D sin eta)]^C)
template <typename Scalar>
Scalar sigma_function(const Scalar& A, const Scalar& B, const Scalar& C, const Scalar& D, double sin_eta) {
  using std::atan, std::exp, std::pow;
  return A * exp(-B * pow(atan(D * sin_eta), C));
}

// m_x [rad], towards the nearer flow direction: A atan(D sin eta cos eta) exp(-B sin eta + C cos eta)
template <typename Scalar>
Scalar mean_function(const Scalar& A, const Scalar& B, const Scalar& C, const Scalar& D, double sin_eta,
                     double cos_eta) {
  using std::atan, std::exp;
  return A * atan(D * (sin_eta * cos_eta)) * exp(-B * sin_eta + C * cos_eta);
}

}  // namespace floe

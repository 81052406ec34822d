// The older descriptions of anisotropic ice: absorption and scattering that depend on the direction
// (arXiv:1309.7010; absorption: arXiv:2107.08692). Components (n1, n2, n3) are along the flow, across it
// in the horizontal plane, and up.
#pragma once

#include <cmath>

namespace floe {

// The factor of the absorption coefficient: 1/sqrt((K1 n1)^2 + (K2 n2)^2 + (Kz n3)^2).
template <typename Scalar>
Scalar absorption_anisotropy_factor(Scalar K1, Scalar K2, Scalar Kz, Scalar n1, Scalar n2, Scalar n3) {
  const Scalar a = K1 * n1, b = K2 * n2, c = Kz * n3;
  return 1 / std::sqrt(a * a + b * b + c * c);
}

// The factor that the oldest models apply, from the scattering anisotropy's k1, k2 (natural logs):
// ((B2 - nB) An / 2)^f, l_i = K_i^2, An = sum n_i^2 l_i, nB = sum n_i^2/l_i, B2 = sum 1/l_i, K3 = 1/(K1 K2).
template <typename Scalar>
Scalar old_absorption_factor(Scalar k1, Scalar k2, Scalar f, Scalar n1, Scalar n2, Scalar n3) {
  const Scalar l1 = std::exp(2 * k1), l2 = std::exp(2 * k2), l3 = 1 / (l1 * l2);
  const Scalar s1 = n1 * n1, s2 = n2 * n2, s3 = n3 * n3;
  const Scalar B2 = 1 / l1 + 1 / l2 + 1 / l3;
  const Scalar nB = s1 / l1 + s2 / l2 + s3 / l3;
  const Scalar An = s1 * l1 + s2 * l2 + s3 * l3;
  return std::exp(f * std::log((B2 - nB) * An / 2));
}

// Anisotropic scattering scatters in a stretched space: (n1, n2, n3) -> (K1 n1, K2 n2, n3/(K1 K2)),
// normalised; with K1, K2 inverted the same map leads back.
template <typename Scalar>
void stretch_direction(Scalar K1, Scalar K2, Scalar& n1, Scalar& n2, Scalar& n3) {
  n1 *= K1;
  n2 *= K2;
  n3 /= K1 * K2;
  const Scalar norm = 1 / std::sqrt(n1 * n1 + n2 * n2 + n3 * n3);
  n1 *= norm;
  n2 *= norm;
  n3 *= norm;
}

}  // namespace floe

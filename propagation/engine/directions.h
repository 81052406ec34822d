// Turning directions: the geometry that sources and scattering share.
#pragma once

#include <cmath>

#include "data/base/vec3.h"
#include "propagation/engine/vector_math.h"

namespace floe {

// Two unit vectors that complete the unit vector n to a right-handed frame (Duff et al., JCGT 6(1),
// 2017): smooth except at n = -z.
template <typename Vector>
struct Frame {
  Vector first, second;
};
template <typename Vector>
Frame<Vector> frame_around(const Vector& n) {
  using Scalar = typename Vector::Scalar;
  const Scalar sign = std::copysign(Scalar(1), n.z());
  const Scalar a = Scalar(-1) / (sign + n.z());
  const Scalar b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}};
}

// The unit vector at angle theta to n, given as 1 - cos(theta) in [0, 2] to keep small angles exact, at
// `turn` (a fraction of a full turn) around it.
template <typename Vector, typename Scalar>
Vector deflect(const Vector& n, Scalar one_minus_cos, Scalar turn) {
  const auto [first, second] = frame_around(n);
  const Scalar sine = std::sqrt(one_minus_cos * (2 - one_minus_cos));
  const Scalar angle = Scalar(2 * pi) * turn;
  const Vector turned =
      n + sine * std::cos(angle) * first + sine * std::sin(angle) * second - one_minus_cos * n;
  return turned.normalized();
}

}  // namespace floe

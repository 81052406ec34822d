// Turning directions: the geometry that sources and scattering share.
#pragma once

#include <cmath>

#include "data/base/vec3.h"
#include "propagation/engine/vector_math.h"

namespace floe {

// Turns the unit vector n by the angle theta, given as 1 - cos(theta) in [0, 2] to keep small angles exact,
// towards (cosine, sine) of a turn around it. The frame around n is that of Duff et al., JCGT 6(1), 2017:
// smooth except at n = -z. By components and without branches: vector loops call it, too.
template <typename Scalar>
[[gnu::always_inline]] inline void deflect(Scalar one_minus_cos, Scalar cosine, Scalar sine, Scalar& nx,
                                           Scalar& ny, Scalar& nz) {
  const Scalar x = nx, y = ny, z = nz;
  const Scalar sign = std::copysign(Scalar(1), z);
  const Scalar a = -1 / (sign + z), b = x * y * a;
  const Scalar across = std::sqrt(one_minus_cos * (2 - one_minus_cos));
  const Scalar c = across * cosine, s = across * sine;
  const Scalar mx = x - one_minus_cos * x + c * (1 + sign * x * x * a) + s * b;
  const Scalar my = y - one_minus_cos * y + c * sign * b + s * (sign + y * y * a);
  const Scalar mz = z - one_minus_cos * z - c * sign * x - s * y;
  const Scalar norm = 1 / std::sqrt(mx * mx + my * my + mz * mz);
  nx = mx * norm;
  ny = my * norm;
  nz = mz * norm;
}

// The same for a vector, at `turn`, a fraction of a full turn, around n.
template <typename Vector, typename Scalar>
Vector deflect(const Vector& n, Scalar one_minus_cos, Scalar turn) {
  const auto around = turn_functions(turn);
  Vector turned = n;
  deflect(one_minus_cos, around.cosine, around.sine, turned.x(), turned.y(), turned.z());
  return turned;
}

}  // namespace floe

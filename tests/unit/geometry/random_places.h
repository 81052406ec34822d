// Random numbers and directions for geometry's tests.
#pragma once

#include <cmath>
#include <random>

#include "data/base/vec3.h"

namespace floe::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vec3 random_direction(Random& random) {
  return unit_vector(std::acos(uniform(random, -1, 1)), uniform(random, 0, 2 * pi));
}

}  // namespace floe::test

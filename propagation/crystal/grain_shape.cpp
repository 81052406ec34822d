#include "propagation/crystal/grain_shape.h"

namespace floe {

namespace {

// Mean over directions of 1/chord, for the unit sphere's chord 4/3, by midpoints: smooth and even in all
// components, so that a few hundred points give it to rounding.
double mean_rate(const std::array<double, 3>& axes) {
  constexpr int rings = 400, places = 200;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < places; ++k) {
      const double z = (i + 0.5) / rings, phi = pi / 2 * (k + 0.5) / places, s = std::sqrt(1 - z * z);
      sum += std::hypot(s * std::cos(phi) / axes[0], s * std::sin(phi) / axes[1], z / axes[2]);
    }
  return sum / (rings * places);
}

}  // namespace

double relative_chord(const GrainShape& shape, const Vec3& direction) {
  const auto& [a, b, c] = shape.axes;
  return mean_rate(shape.axes) / std::hypot(direction.x() / a, direction.y() / b, direction.z() / c);
}

}  // namespace floe

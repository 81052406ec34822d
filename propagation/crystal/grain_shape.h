// Grains as ellipsoids: how their boundaries lie to a ray that crosses them, and how far apart.
#pragma once

#include <array>
#include <cmath>

#include "data/base/vec3.h"
#include "propagation/engine/vector_math.h"

namespace floe {

// The axes of the crystal frame: x along the flow, y across it in the horizontal plane (tilt), z up.
// Semi-axes along them, all > 0; only their ratios decide on orientations.
struct GrainShape {
  std::array<double, 3> axes{1, 1, 1};
};

// A spheroid along the flow: long axis / short axis = elongation (below 1: flattened along the flow).
inline GrainShape spheroid(double elongation) {
  return {{elongation, 1, 1}};
}

// The unit normal, along the ray, of the boundary where the ray with the unit direction `ray` leaves a grain.
// Its density is that of the ellipsoid's normals, weighted by |normal . ray|, the rate of crossings. Parallel
// rays fill the ellipsoid's shadow evenly. An affine map makes the ellipsoid the unit sphere, and even stays
// even: a place on the disc across the mapped ray, of squared radius u1 in (0, 1) and at any turn around it,
// gives the place on the sphere, and mapping back its normal.
template <typename Turn>
[[gnu::always_inline]] inline void boundary_normal(std::array<double, 3> axes, double rx, double ry,
                                                   double rz, double u1, Turn turn, double& nx, double& ny,
                                                   double& nz) {
  const double a = axes[0], b = axes[1], c = axes[2];
  const double qx = rx / a, qy = ry / b, qz = rz / c;
  const double norm = 1 / std::sqrt(qx * qx + qy * qy + qz * qz);
  const double x = qx * norm, y = qy * norm, z = qz * norm;
  // Frame across the mapped ray, as in deflect() (Duff et al., JCGT 6(1), 2017).
  const double sign = std::copysign(1.0, z), f = -1 / (sign + z), g = x * y * f;
  const double radius = std::sqrt(u1), depth = std::sqrt(1 - u1);
  const double p = radius * turn.cosine, q = radius * turn.sine;
  const double ux = depth * x + p * (1 + sign * x * x * f) + q * g;
  const double uy = depth * y + p * sign * g + q * (sign + y * y * f);
  const double uz = depth * z - p * sign * x - q * y;
  const double mx = ux / a, my = uy / b, mz = uz / c;
  const double scale = 1 / std::sqrt(mx * mx + my * my + mz * mz);
  nx = mx * scale;
  ny = my * scale;
  nz = mz * scale;
}

// Mean chord of the ellipsoid along a direction, in units of its mean over directions weighted by how often
// grains are met, 4 V/surface: isotropic rays then need 1 of these units a crossing.
double relative_chord(const GrainShape& shape, const Vec3& direction);

}  // namespace floe

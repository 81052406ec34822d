// Vectors in the detector frame: x east-like, y grid north, z up; metres.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace floe {

using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;  // 1 deg in radians

// Unit vector of the polar angle theta (from +z) and azimuth phi (from +x) [rad].
inline Vec3 unit_vector(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Direction in which a particle travels that comes FROM (zenith, azimuth) [rad].
inline Vec3 travel_direction(double zenith, double azimuth) {
  return -unit_vector(zenith, azimuth);
}

// Zenith in [0, pi] and azimuth in [0, 2 pi) [rad] from which a particle that travels along the unit
// vector `direction` comes; the inverse of travel_direction.
struct Origin {
  double zenith;
  double azimuth;
};
inline Origin origin_of(const Vec3& direction) {
  const double azimuth = std::atan2(-direction.y(), -direction.x());
  return {std::acos(std::clamp(-direction.z(), -1.0, 1.0)), azimuth < 0 ? azimuth + 2 * pi : azimuth};
}

}  // namespace floe

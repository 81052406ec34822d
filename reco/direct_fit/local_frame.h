// Small changes of a cascade, as seven numbers around an origin.
#pragma once

#include "reco/direct_fit/cascade_parameters.h"
#include "reco/direct_fit/poisson_regression.h"

namespace floe {

// Place of the light centre [m], direction as an angle vector on the tangent plane of the sphere of
// directions [rad] (exponential map, no pole anywhere near), time at the light centre [ns], and
// logarithm of the light; all relative to the origin. The first five are the regression's coordinates.
class LocalFrame {
 public:
  explicit LocalFrame(const LightCentre& origin);
  const LightCentre& origin() const { return origin_; }
  LightCentre at(const Vector7& local) const;
  Vector7 of(const LightCentre& light) const;

  // d direction / d (fourth and fifth local number), a row each.
  using DirectionChange = Eigen::Matrix<double, 2, 3>;
  DirectionChange direction_change(const Vector7& local) const;

  // Jacobian of (x, y, z, t, zenith, azimuth, energy) with respect to the local numbers, at `local`.
  Matrix7 jacobian(const Vector7& local, CascadeKind kind) const;

 private:
  LightCentre origin_;
  Vec3 axis1_, axis2_;  // with the direction, an orthonormal basis
};

}  // namespace floe

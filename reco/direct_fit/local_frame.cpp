#include "reco/direct_fit/local_frame.h"

#include <Eigen/Geometry>
#include <cmath>

namespace floe {

LocalFrame::LocalFrame(const LightCentre& origin) : origin_(origin) {
  axis1_ = origin_.direction.unitOrthogonal();
  axis2_ = origin_.direction.cross(axis1_);
}

LightCentre LocalFrame::at(const Vector7& local) const {
  LightCentre light = origin_;
  light.position += local.head<3>();
  const Vec3 tangent = local(3) * axis1_ + local(4) * axis2_;
  const double angle = tangent.norm();
  if (angle > 0) light.direction = std::cos(angle) * origin_.direction + std::sin(angle) / angle * tangent;
  light.direction.normalize();
  light.time += local(5);
  light.log_light += local(6);
  return light;
}

Vector7 LocalFrame::of(const LightCentre& light) const {
  const double a = light.direction.dot(axis1_), b = light.direction.dot(axis2_);
  const double sine = std::hypot(a, b), angle = std::atan2(sine, light.direction.dot(origin_.direction));
  const double stretch = sine > 0 ? angle / sine : 1;
  Vector7 local;
  local << light.position - origin_.position, stretch * a, stretch * b, light.time - origin_.time,
      light.log_light - origin_.log_light;
  return local;
}

LocalFrame::DirectionChange LocalFrame::direction_change(const Vector7& local) const {
  const double a = std::hypot(local(3), local(4));
  const double sinc = a > 1e-6 ? std::sin(a) / a : 1;
  const double bend = a > 1e-3 ? (std::cos(a) - sinc) / (a * a) : -1.0 / 3;  // (d sinc / d a) / a
  const Vec3 tangent = local(3) * axis1_ + local(4) * axis2_;
  DirectionChange change;
  change.row(0) = local(3) * (bend * tangent - sinc * origin_.direction) + sinc * axis1_;
  change.row(1) = local(4) * (bend * tangent - sinc * origin_.direction) + sinc * axis2_;
  return change;
}

Matrix7 LocalFrame::jacobian(const Vector7& local, CascadeKind kind) const {
  const Vector7 step = (Vector7() << 0.01, 0.01, 0.01, 1e-4, 1e-4, 0.01, 1e-4).finished();
  Matrix7 result;
  for (int i = 0; i < 7; ++i) {
    Vector7 up = local, down = local;
    up(i) += step(i);
    down(i) -= step(i);
    Vector7 change = to_vector(cascade_of(at(up), kind)) - to_vector(cascade_of(at(down), kind));
    change(5) = std::remainder(change(5), 2 * pi);
    result.col(i) = change / (2 * step(i));
  }
  return result;
}

}  // namespace floe

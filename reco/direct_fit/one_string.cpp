#include "reco/direct_fit/one_string.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace floe {

std::optional<Vec3> axis_of_only_string(const EventData& data) {
  constexpr double nearly_all = 0.85;
  std::map<int, double> charge;
  for (const ModuleData& lit : data.lit())
    charge[data.detector().modules()[lit.module].id.string] += lit.charge;
  for (const ModuleData& lit : data.lit()) {
    const Module& module = data.detector().modules()[lit.module];
    if (charge[module.id.string] > nearly_all * data.charge()) return module.position;
  }
  return std::nullopt;
}

LightCentre turned_about(const Vec3& axis, double angle, const LightCentre& light) {
  const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
  LightCentre turned = light;
  turned.position = axis + turn * (light.position - axis);
  turned.direction = turn * light.direction;
  return turned;
}

LightCentre mirrored_about(const Vec3& axis, const LightCentre& light) {
  LightCentre mirrored = light;
  const Vec3 across = (light.position - axis).cross(Vec3::UnitZ()).normalized();  // 0 on the axis
  mirrored.direction -= 2 * across.dot(light.direction) * across;
  return mirrored;
}

Matrix7 with_arc_about(const Vec3& axis, const CascadeParameters& best, const Matrix7& covariance) {
  Eigen::Vector2d outward = (best.position - axis).head<2>();
  const double radius = outward.norm();
  if (radius == 0 || !covariance.allFinite()) return covariance;
  outward /= radius;
  const Eigen::Vector2d along(-outward.y(), outward.x());
  const double variance = along.dot(covariance.topLeftCorner<2, 2>() * along) / (radius * radius);
  // <(1 - cos a)^2> of a Gaussian a
  const double inside = 1 - 2 * std::exp(-variance / 2) + (1 + std::exp(-2 * variance)) / 2;
  Matrix7 with_arc = covariance;
  with_arc.topLeftCorner<2, 2>() += radius * radius * inside * outward * outward.transpose();
  return with_arc;
}

}  // namespace floe

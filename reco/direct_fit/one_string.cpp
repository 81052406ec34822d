#include "reco/direct_fit/one_string.h"

#include <Eigen/Geometry>
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

}  // namespace floe

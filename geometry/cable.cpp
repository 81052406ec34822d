#include "data/base/constants.h"
#include "geometry/acceptance.h"

namespace floe {

bool cable_shadows(double cable_azimuth, const Vec3& photon_direction, const Vec3& inward, double radius) {
  using Vec2 = Eigen::Vector2d;
  // The cable is vertical and long, so only the horizontal plane matters, with the cable's axis as origin.
  const Vec2 axis = (module_radius + radius) * Vec2(std::cos(cable_azimuth), std::sin(cable_azimuth));
  const Vec2 landing = -module_radius * inward.head<2>() - axis;
  const Vec2 back = -photon_direction.head<2>();
  const double approach = -landing.dot(back);  // > 0 when the photon came from the cable's side
  if (approach <= 0) return false;
  const double closest_squared = landing.squaredNorm() - approach * approach / back.squaredNorm();
  return closest_squared <= radius * radius;
}

}  // namespace floe

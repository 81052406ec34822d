#include <cmath>

#include "data/base/constants.h"
#include "geometry/module_scene.h"

namespace floe {

namespace {
// More than single precision loses here, within some hundred metres of the module [m, m^2].
constexpr float margin = 0.05F;
}  // namespace

// In double precision: near the rim the square root turns a rounding error of 1e-5 m into millimetres.
bool cross_module(const Vec3f& centre, float oversize, const Vec3f& origin, const Vec3f& direction,
                  float length, ModuleCrossing& crossing) {
  // Most segments miss by far, which single precision can tell.
  const Vec3f offset = centre - origin;
  const float ahead = offset.dot(direction), reach = oversize * static_cast<float>(module_radius) + margin;
  if (ahead < -margin || ahead - reach > length ||
      offset.squaredNorm() - ahead * ahead > reach * reach + margin)
    return false;

  const Vec3 along = direction.cast<double>();
  const Vec3 to_centre = centre.cast<double>() - origin.cast<double>();
  const double closest = to_centre.dot(along) / along.squaredNorm();
  const Vec3 across = (to_centre - closest * along) / oversize;  // on the module of nominal size
  const double half_chord_squared = module_radius * module_radius - across.squaredNorm();
  if (half_chord_squared < 0) return false;
  const double half_chord = std::sqrt(half_chord_squared);
  const double distance = closest - half_chord;
  if (!(distance > 0 && distance <= length)) return false;
  crossing.distance = static_cast<float>(distance);
  crossing.inward = ((across + half_chord * along) / module_radius).normalized().cast<float>();
  return true;
}

}  // namespace floe

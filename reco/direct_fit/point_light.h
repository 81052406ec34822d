// Light of a point in ice in closed form: a rough guide that takes the steepest dependences (1/r near
// the source, arrival with the speed of light) out of what simulations have to tell.
#pragma once

#include <vector>

#include "data/base/vec3.h"
#include "propagation/ice/ice_model.h"

namespace floe {

// Effective scattering and absorption lengths [m] at 400 nm.
struct IceLengths {
  double scattering = 0, absorption = 0;
};

// Means of the inverse lengths along vertical intervals; layers flat.
class MeanIce {
 public:
  explicit MeanIce(IceLengths everywhere);
  explicit MeanIce(const IceModel& ice);
  // Between two heights [m].
  IceLengths between(double z1, double z2) const;

 private:
  struct Sum {
    double scattering, absorption;
  };
  Sum integral(double z) const;  // of the inverse lengths from z_bottom_ to z

  double z_bottom_ = 0, step_ = 1;
  std::vector<Sum> inverse_;  // of each layer [1/m]
  std::vector<Sum> below_;    // integral below each layer
};

// Relative light at distance r [m] from an isotropic point source,
//   exp(-r/l_p) / (4 pi l_c r tanh(r/l_c)),  l_c = l_e/(3 zeta), zeta = exp(-l_e/l_a), l_p = sqrt(l_a l_e/3),
// which joins 1/r^2 near the source to diffusion far from it (arXiv:1208.3430, eq. 6), with its
// derivative. See soft_distance for sources inside a module.
struct PointLight {
  double log_light;  // ln(light [1/m^2])
  double slope;      // d log_light / dr [1/m]
};
PointLight point_light(double r, const IceLengths& ice);

// Distance from a cascade, which is some metres long and never closer than that to anything:
// sqrt(d^2 + (2 m)^2), smooth everywhere. Its gradient is offset / soft_distance.
double soft_distance(const Vec3& offset);

// Slowness of the first light [ns/m]: group index at 400 nm over the speed of light.
double light_slowness();

}  // namespace floe

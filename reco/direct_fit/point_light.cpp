#include "reco/direct_fit/point_light.h"

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"

namespace floe {

MeanIce::MeanIce(IceLengths everywhere) {
  inverse_ = {{1 / everywhere.scattering, 1 / everywhere.absorption}};
  below_ = {{0, 0}};
}

MeanIce::MeanIce(const IceModel& ice) : z_bottom_(ice.z_bottom()), step_(ice.layer_step()) {
  Sum sum{0, 0};
  for (int layer = 0; layer < static_cast<int>(ice.layers().size()); ++layer) {
    inverse_.push_back({ice.effective_scattering(layer, 400), ice.absorption(layer, 400)});
    below_.push_back(sum);
    sum.scattering += step_ * inverse_.back().scattering;
    sum.absorption += step_ * inverse_.back().absorption;
  }
}

MeanIce::Sum MeanIce::integral(double z) const {
  const double place = std::clamp(std::floor((z - z_bottom_) / step_), 0.0, double(inverse_.size() - 1));
  const auto layer = static_cast<std::size_t>(place);
  const double inside = z - (z_bottom_ + place * step_);
  return {below_[layer].scattering + inside * inverse_[layer].scattering,
          below_[layer].absorption + inside * inverse_[layer].absorption};
}

IceLengths MeanIce::between(double z1, double z2) const {
  const double low = std::min(z1, z2), high = std::max({z1, z2, low + 1});
  const Sum a = integral(low), b = integral(high);
  return {(high - low) / (b.scattering - a.scattering), (high - low) / (b.absorption - a.absorption)};
}

PointLight point_light(double r, const IceLengths& ice) {
  const double zeta = std::exp(-ice.scattering / ice.absorption);
  const double lc = ice.scattering / (3 * zeta), lp = std::sqrt(ice.absorption * ice.scattering / 3);
  const double x = r / lc;
  PointLight result;
  result.log_light = -r / lp - std::log(4 * pi * lc * r * std::tanh(x));
  // d ln tanh(x)/dx = 2/sinh(2x), which is 0 long before sinh overflows.
  result.slope = -1 / lp - 1 / r - (x < 20 ? 2 / std::sinh(2 * x) / lc : 0);
  return result;
}

double soft_distance(const Vec3& offset) {
  return std::sqrt(offset.squaredNorm() + 4);
}

double light_slowness() {
  return group_index(400) / speed_of_light;
}

}  // namespace floe

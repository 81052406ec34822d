#include "propagation/sources/cherenkov.h"

#include <algorithm>
#include <cmath>

#include "propagation/ice/ice_model.h"

namespace floe {

QuantileTable shower_particle_angles() {
  constexpr double a = 0.39, b = 2.61;
  const double normalisation = 1 - std::exp(-b * std::exp2(a));
  return QuantileTable::of_quantile([normalisation](double u) {
    return std::min(2.0, std::pow(-std::log1p(-u * normalisation) / b, 1 / a));
  });
}

QuantileTable cherenkov_angles(const WavelengthSpectrum& spectrum) {
  return QuantileTable::of_quantile([&](double u) { return 1 - 1 / phase_index(spectrum.sample(u)); });
}

}  // namespace floe

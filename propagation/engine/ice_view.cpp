#include "propagation/engine/ice_view.h"

#include <algorithm>
#include <cmath>

namespace floe {

IceView::IceView(const IceModel& ice)
    : last_layer(static_cast<int>(ice.layers().size()) - 1),
      z_bottom(static_cast<float>(ice.z_bottom())),
      step(static_cast<float>(ice.layer_step())),
      layers_per_metre(static_cast<float>(1 / ice.layer_step())),
      anisotropic_scattering(false),
      old_absorption_scaling(static_cast<float>(ice.old_absorption_scaling())),
      flow_x(static_cast<float>(std::cos(ice.flow_azimuth()))),
      flow_y(static_cast<float>(std::sin(ice.flow_azimuth()))),
      absorption_K1(static_cast<float>(ice.absorption_anisotropy()[0])),
      absorption_K2(static_cast<float>(ice.absorption_anisotropy()[1])),
      absorption_Kz(static_cast<float>(ice.absorption_anisotropy()[2])),
      scattering{static_cast<float>(ice.simplified_liu_fraction()), static_cast<float>(ice.mean_cosine())},
      birefringent(ice.birefringence().has_value()),
      displacement(birefringent && ice.birefringence()->displacement) {
  const double geometric = 1 / (1 - ice.mean_cosine());
  for (const IceLayer& layer : ice.layers()) {
    TableRow row{};
    row.values[scattering_constant] = static_cast<float>(geometric * layer.scattering_constant);
    row.values[scattering_power] = static_cast<float>(geometric * layer.scattering_power);
    row.values[absorption_dust] = static_cast<float>(layer.absorption_dust);
    row.values[absorption_thermal] = static_cast<float>(layer.absorption_thermal);
    row.values[diffusion] = static_cast<float>(layer.diffusion_strength);
    row.values[deflection] = static_cast<float>(layer.deflection_strength);
    row.values[k1] = static_cast<float>(layer.k1);
    row.values[k2] = static_cast<float>(layer.k2);
    layers.push_back(row);
    anisotropic_scattering |= layer.k1 != 0 || layer.k2 != 0;
  }
  if (birefringent) tabulate_birefringence(*ice.birefringence());
}

void IceView::tabulate_birefringence(const BirefringenceNumbers& numbers) {
  birefringence.assign(birefringence_intervals, {});
  const auto fill = [this](BirefringenceColumn value, BirefringenceColumn change, auto function) {
    // The drift is 0/0 at both ends: a place just inside has the limit.
    const auto at = [&](int i) {
      return function(std::clamp(static_cast<double>(i) / birefringence_intervals, 1e-6, 1 - 1e-9));
    };
    for (int i = 0; i < birefringence_intervals; ++i) {
      birefringence[i].values[value] = static_cast<float>(at(i));
      birefringence[i].values[change] = static_cast<float>(at(i + 1) - at(i));
    }
  };
  const double wide = numbers.diffusion ? 1 : 0, drifts = numbers.deflection ? 1 : 0;
  fill(sigma_x, sigma_x_change,
       [&](double cosine) { return wide * diffusion_step(numbers, cosine).sigma_x; });
  fill(sigma_y, sigma_y_change,
       [&](double cosine) { return wide * diffusion_step(numbers, cosine).sigma_y; });
  fill(drift, drift_change, [&](double cosine) {
    return drifts * diffusion_step(numbers, cosine).mean_x / (cosine * std::sqrt(1 - cosine * cosine));
  });
}

}  // namespace floe

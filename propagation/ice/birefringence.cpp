#include <algorithm>
#include <cmath>

#include "data/base/vec3.h"
#include "propagation/ice/diffusion_functions.h"
#include "propagation/ice/ice_model.h"

namespace floe {

namespace {

double sigma(const DiffusionFunction& f, double sin_eta) {
  return sigma_function(f.A, f.B, f.C, f.D, sin_eta);
}

double mean(const DiffusionFunction& f, double sin_eta, double cos_eta) {
  return mean_function(f.A, f.B, f.C, f.D, sin_eta, cos_eta);
}

}  // namespace

DiffusionStep diffusion_step(const BirefringenceNumbers& numbers, double abs_cos_eta) {
  const double cos_eta = std::clamp(abs_cos_eta, 0.0, 1.0);
  const double sin_eta = std::sqrt((1 - cos_eta) * (1 + cos_eta));
  return {sigma(numbers.sigma_x, sin_eta), sigma(numbers.sigma_y, sin_eta),
          mean(numbers.mean_x, sin_eta, cos_eta)};
}

double mean_birefringent_scattering(const BirefringenceNumbers& numbers) {
  // Simpson's rule over eta, where the integrand is smooth (over cos eta its slope diverges along the
  // flow): int_0^(pi/2) f(eta) sin eta d eta. 2000 intervals leave an error below 1e-9 of the value.
  constexpr int intervals = 2000;
  const double step = pi / 2 / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double eta = i * step;
    const DiffusionStep d = diffusion_step(numbers, std::cos(eta));
    const double weight = i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2;
    sum += weight * std::sin(eta) * (d.sigma_x * d.sigma_x + d.sigma_y * d.sigma_y + d.mean_x * d.mean_x) / 2;
  }
  return sum * step / 3;
}

}  // namespace floe

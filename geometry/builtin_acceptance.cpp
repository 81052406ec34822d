// The built-in acceptance: a nominal IceCube module as published curves show it, idealised. Measured data
// deserve the calibrated files (as.dat, wv.dat, wv.rde) of an ice model instead.
#include <array>

#include "geometry/acceptance.h"

namespace floe {

namespace {

// Angular sensitivity in the refrozen hole: 0.34 (1 + 1.5 x - x^3/2) + p x (x^2-1)^3 with x = cos(eta), the
// one-parameter family in use for IceCube's hole ice (reviewed in arXiv:2307.15298), at p = 0.3. Its
// maximum is the head-on value 0.68.
AngularAcceptance hole_ice_acceptance() {
  constexpr double p = 0.3, half = 0.34;
  return AngularAcceptance::polynomial(2 * half,
                                       {half, 1.5 * half - p, 0, -0.5 * half + 3 * p, 0, -3 * p, 0, p});
}

// Sensitive area for light that meets the photomultiplier head-on [cm^2], after the optical efficiency of
// glass, gel and photocathode in arXiv:1002.2442, section 3: opaque below 300 nm, best near 420 nm.
struct Sensitivity {
  double wavelength, area;
};
constexpr std::array<Sensitivity, 15> sensitivity{{{300, 0},
                                                   {320, 11},
                                                   {340, 52},
                                                   {360, 87},
                                                   {380, 104},
                                                   {400, 111},
                                                   {420, 114},
                                                   {450, 106},
                                                   {480, 93},
                                                   {510, 72},
                                                   {540, 48},
                                                   {570, 30},
                                                   {600, 17},
                                                   {630, 7},
                                                   {660, 0}}};

double sensitive_area(double wavelength) {
  for (std::size_t k = 1; k < sensitivity.size(); ++k) {
    const auto& [low, low_area] = sensitivity[k - 1];
    const auto& [high, high_area] = sensitivity[k];
    if (wavelength >= low && wavelength <= high)
      return low_area + (high_area - low_area) * (wavelength - low) / (high - low);
  }
  return 0;
}

// Cherenkov photons of a fast particle per path and wavelength, up to a constant (Frank and Tamm).
// Phase index of ice: Price and Woschnagg, Astropart. Phys. 15, 97 (2001), with w in micrometres.
double cherenkov_yield(double wavelength) {
  const double w = wavelength / 1000;
  const double n = 1.55749 + w * (-1.57988 + w * (3.99993 + w * (-4.68271 + w * 2.09354)));
  return (1 - 1 / (n * n)) / (wavelength * wavelength);
}

WavelengthSpectrum cherenkov_spectrum() {
  constexpr double step = 10;  // [nm]
  const auto weight = [](double wavelength) {
    return cherenkov_yield(wavelength) * sensitive_area(wavelength);
  };
  std::vector<WavelengthSpectrum::Point> points{{0, sensitivity.front().wavelength}};
  while (points.back().wavelength < sensitivity.back().wavelength) {
    const auto [cumulative, low] = points.back();
    // Simpson's rule; the spectrum is uniform within a step.
    const double share = step / 6 * (weight(low) + 4 * weight(low + step / 2) + weight(low + step));
    points.push_back({cumulative + share, low + step});
  }
  const double total = points.back().cumulative;
  for (auto& point : points) point.cumulative /= total;
  return WavelengthSpectrum(std::move(points));
}

}  // namespace

ModuleAcceptance builtin_acceptance() {
  ModuleAcceptance acceptance;
  acceptance.angular = hole_ice_acceptance();
  acceptance.spectrum = cherenkov_spectrum();
  return acceptance;
}

}  // namespace floe

#include "propagation/sources/cascade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/ice/ice_model.h"

namespace floe {

namespace {

// The parametrisations of arXiv:1210.5140 were made for a density of 0.910 g/cm3; the ice has 0.9216.
constexpr double density_ratio = 0.910 / 0.9216;
constexpr double radiation_length = 0.39652 * density_ratio;       // [m]
constexpr double track_length_per_energy = 5.321 * density_ratio;  // of an EM cascade [m/GeV]
constexpr double muon_mass = 0.105658389;  // below it the profile is not defined [GeV]

// pi+ of arXiv:1210.5140, the usual stand-in for any hadronic cascade.
struct HadronNumbers {
  double E0 = 0.18791678, m = 0.16267529, f0 = 0.30974123, rms0 = 0.95899551, gamma = 1.35589541;
};

// Angle of the emitting particles to the axis: 1 - cos = (-ln(1 - u I)/b)^(1/a).
QuantileTable particle_angles() {
  constexpr double a = 0.39, b = 2.61;
  const double normalisation = 1 - std::exp(-b * std::exp2(a));
  return QuantileTable::of_quantile([normalisation](double u) {
    return std::min(2.0, std::pow(-std::log1p(-u * normalisation) / b, 1 / a));
  });
}

// Quantiles of the gamma distribution; its upper end holds less than 1e-8 beyond.
QuantileTable depths_of(const LongitudinalProfile& profile) {
  const double shape = profile.shape, end = shape + 8 * std::sqrt(shape) + 20;  // in units of the scale
  return QuantileTable::of_density(0, end * profile.scale, [&](double depth) {
    const double x = depth / profile.scale;
    if (x <= 0) return shape < 1 ? 0.0 : shape == 1 ? 1.0 : 0.0;
    return std::exp((shape - 1) * std::log(x) - x - std::lgamma(shape));
  });
}

}  // namespace

CascadeKind cascade_kind_of(const std::string& name) {
  if (name == "e-") return CascadeKind::electron;
  if (name == "e+") return CascadeKind::positron;
  if (name == "gamma") return CascadeKind::gamma;
  if (name == "hadron") return CascadeKind::hadron;
  throw UsageError(fmt::format("unknown particle '{}'; known are e-, e+, gamma and hadron", name));
}

namespace {
LongitudinalProfile parametrised_profile(CascadeKind kind, double energy) {
  const double log_energy = std::log(std::max(muon_mass, energy));
  switch (kind) {
    case CascadeKind::positron:
      return {2.00035 + 0.63190 * log_energy, radiation_length / 0.63008};
    case CascadeKind::gamma:
      return {2.83923 + 0.58209 * log_energy, radiation_length / 0.64526};
    case CascadeKind::hadron:
      return {1.58357292 + 0.41886807 * log_energy, radiation_length / 0.33833116};
    case CascadeKind::electron:
      break;
  }
  return {2.01849 + 0.63176 * log_energy, radiation_length / 0.63207};
}
}  // namespace

LongitudinalProfile longitudinal_profile(CascadeKind kind, double energy) {
  const LongitudinalProfile profile = parametrised_profile(kind, energy);
  // Far below a GeV the parametrised shape becomes negative; there the light is at the vertex.
  return {std::max(profile.shape, 0.05), profile.scale};
}

LightYield light_yield(CascadeKind kind, double energy) {
  const double electromagnetic = track_length_per_energy * energy;
  if (kind != CascadeKind::hadron) return {electromagnetic, 0};
  const HadronNumbers h;
  const double e = std::max(std::exp(1.0), energy);
  const double fraction = 1 - std::pow(e / h.E0, -h.m) * (1 - h.f0);
  const double spread = fraction * h.rms0 * std::pow(std::log(e), -h.gamma);
  return {electromagnetic * fraction, electromagnetic * spread};
}

double draw_yield_fluctuation(CascadeKind kind, double energy, RandomStream& random) {
  const LightYield yield = light_yield(kind, energy);
  if (yield.spread == 0) return 1;
  const double electromagnetic = track_length_per_energy * energy;
  std::normal_distribution<double> gaussian(yield.mean, yield.spread);
  // A hadronic cascade makes light, and not more than 10% above an electromagnetic one.
  double light = -1;
  while (light < 0 || light > 1.1 * electromagnetic) light = gaussian(random);
  return light / yield.mean;
}

CascadeSource::CascadeSource(const Cascade& cascade, const WavelengthSpectrum& spectrum,
                             double yield_fluctuation)
    : cascade_(cascade),
      vertex_(cascade.position.cast<float>()),
      axis_(travel_direction(cascade.zenith, cascade.azimuth).cast<float>()),
      profile_(longitudinal_profile(cascade.kind, cascade.energy)),
      wavelengths_(QuantileTable::of_quantile([&](double u) { return spectrum.sample(u); })),
      cherenkov_angles_(
          QuantileTable::of_quantile([&](double u) { return 1 - 1 / phase_index(spectrum.sample(u)); })),
      depths_(depths_of(profile_)),
      particle_angles_(particle_angles()),
      photons_(photons_per_metre * light_yield(cascade.kind, cascade.energy).mean * yield_fluctuation) {
  if (!(cascade.energy > 0) || !std::isfinite(cascade.energy))
    throw UsageError(fmt::format("a cascade's energy must be positive, found {} GeV", cascade.energy));
}

double CascadeSource::photons() const {
  return photons_;
}

}  // namespace floe

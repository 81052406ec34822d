#include "propagation/sources/cascade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/sources/cherenkov.h"

namespace floe {

namespace {

constexpr double radiation_length = 0.39652 * density_ratio;       // [m]
constexpr double track_length_per_energy = 5.321 * density_ratio;  // of an EM cascade [m/GeV]
constexpr double muon_mass = 0.105658389;  // below it the profile is not defined [GeV]

// What arXiv:1210.5140 found for cascades of one particle: the shape of the profile is shape + slope ln E,
// its scale the radiation length over `per_radiation_length`; light relative to an electromagnetic cascade:
// F = 1 - (E/E0)^-m (1 - f0), with fluctuations of F rms0 ln(E)^-gamma.
struct HadronNumbers {
  double shape, slope, per_radiation_length, E0, m, f0, rms0, gamma;
};

// Of protons the yield is that of antiprotons with fluctuations of their own, as in the paper: at low energy
// the proton's own fit fails.
const HadronNumbers& numbers_of(CascadeKind kind) {
  static constexpr HadronNumbers pi_plus{1.58357292, 0.41886807, 0.33833116, 0.18791678,
                                         0.16267529, 0.30974123, 0.95899551, 1.35589541},
      pi_minus{1.69176636, 0.40803489, 0.34108075, 0.19826506,
               0.16218006, 0.31859323, 0.94033488, 1.35070162},
      kaon{1.95948974, 0.34934666, 0.34535151, 0.21687243, 0.16861530, 0.27724987, 1.00318874, 1.37528605},
      proton{1.47495778, 0.40450398, 0.35226706, 0.29579368, 0.19373018, 0.02455403, 1.01619344, 1.45477346},
      neutron{1.57739060, 0.40631102, 0.35269455, 0.66725124, 0.19263595, 0.17559033, 1.01414337, 1.45086895},
      antiproton{1.92249171, 0.33701751, 0.34969748, 0.29579368,
                 0.19373018, 0.02455403, 1.01094637, 1.50438415};
  switch (kind) {
    case CascadeKind::pi_minus:
      return pi_minus;
    case CascadeKind::kaon:
      return kaon;
    case CascadeKind::proton:
      return proton;
    case CascadeKind::neutron:
      return neutron;
    case CascadeKind::antiproton:
      return antiproton;
    default:
      return pi_plus;  // the usual stand-in for any hadronic cascade
  }
}

bool is_hadronic(CascadeKind kind) {
  return kind != CascadeKind::electron && kind != CascadeKind::positron && kind != CascadeKind::gamma;
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
  if (name == "hadron" || name == "pi+") return CascadeKind::hadron;
  if (name == "pi-") return CascadeKind::pi_minus;
  if (name == "K0L") return CascadeKind::kaon;
  if (name == "p") return CascadeKind::proton;
  if (name == "n") return CascadeKind::neutron;
  if (name == "pbar") return CascadeKind::antiproton;
  throw UsageError(
      fmt::format("unknown particle '{}'; known are e-, e+, gamma, hadron (the same as pi+), pi+, pi-, K0L, "
                  "p, n and pbar",
                  name));
}

namespace {
LongitudinalProfile parametrised_profile(CascadeKind kind, double energy) {
  const double log_energy = std::log(std::max(muon_mass, energy));
  switch (kind) {
    case CascadeKind::positron:
      return {2.00035 + 0.63190 * log_energy, radiation_length / 0.63008};
    case CascadeKind::gamma:
      return {2.83923 + 0.58209 * log_energy, radiation_length / 0.64526};
    case CascadeKind::electron:
      return {2.01849 + 0.63176 * log_energy, radiation_length / 0.63207};
    default:
      break;
  }
  const HadronNumbers& h = numbers_of(kind);
  return {h.shape + h.slope * log_energy, radiation_length / h.per_radiation_length};
}
}  // namespace

LongitudinalProfile longitudinal_profile(CascadeKind kind, double energy) {
  const LongitudinalProfile profile = parametrised_profile(kind, energy);
  // Far below a GeV the parametrised shape becomes negative; there the light is at the vertex.
  return {std::max(profile.shape, 0.05), profile.scale};
}

LightYield light_yield(CascadeKind kind, double energy) {
  const double electromagnetic = track_length_per_energy * energy;
  if (!is_hadronic(kind)) return {electromagnetic, 0};
  const HadronNumbers& h = numbers_of(kind);
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
      cherenkov_angles_(cherenkov_angles(spectrum)),
      depths_(depths_of(profile_)),
      particle_angles_(shower_particle_angles()),
      photons_(photons_per_metre * light_yield(cascade.kind, cascade.energy).mean * yield_fluctuation) {
  if (!(cascade.energy > 0) || !std::isfinite(cascade.energy))
    throw UsageError(fmt::format("a cascade's energy must be positive, found {} GeV", cascade.energy));
}

double CascadeSource::photons() const {
  return photons_;
}

}  // namespace floe

// Electromagnetic and hadronic cascades (arXiv:1210.5140), Cherenkov light of all their particles.
#pragma once

#include <string>

#include "geometry/acceptance.h"
#include "propagation/sources/quantile_table.h"
#include "propagation/sources/source.h"

namespace floe {

// `hadron` is the cascade of a pi+, the usual stand-in for any hadronic one.
enum class CascadeKind {
  electron,
  positron,
  gamma,
  hadron,
  pi_minus,
  kaon,  // neutral, long-lived
  proton,
  neutron,
  antiproton
};
// "e-", "e+", "gamma", "hadron" or "pi+", "pi-", "K0L", "p", "n", "pbar"; throws UsageError
CascadeKind cascade_kind_of(const std::string& name);

struct Cascade {
  Vec3 position = Vec3::Zero();    // the vertex [m]
  double time = 0;                 // at the vertex [ns]
  double zenith = 0, azimuth = 0;  // where it comes FROM [rad]
  double energy = 0;               // [GeV], > 0
  CascadeKind kind = CascadeKind::electron;
};

// Longitudinal light profile: gamma distribution of shape a and scale b [m] from the vertex.
struct LongitudinalProfile {
  double shape, scale;
};
LongitudinalProfile longitudinal_profile(CascadeKind kind, double energy);

// Light of a cascade in metres of bare track: mean, and relative-to-nothing spread [m] (0 for EM).
struct LightYield {
  double mean, spread;
};
LightYield light_yield(CascadeKind kind, double energy);

// Emission point and time: vertex plus l along the axis at t + l/c, l from the profile; direction: the
// emitting particle's angle to the axis has 1 - cos = (-ln(1 - u I)/b)^(1/a), a = 0.39, b = 2.61, then
// the Cherenkov cone of the photon's wavelength around it.
class CascadeSource : public Source {
 public:
  // `yield_fluctuation`: the light of a hadronic cascade in units of its mean (1 for the expectation).
  CascadeSource(const Cascade& cascade, const WavelengthSpectrum& spectrum, double yield_fluctuation = 1);
  double photons() const override;
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const override;

 private:
  Cascade cascade_;
  Vec3f vertex_, axis_;
  LongitudinalProfile profile_;
  // All against uniform numbers; the angles as 1 - cos, the Cherenkov angle against that of its wavelength.
  QuantileTable wavelengths_, cherenkov_angles_, depths_, particle_angles_;
  double photons_;
};

// A draw of a hadronic cascade's light in units of its mean: Gaussian, cut to physical values.
double draw_yield_fluctuation(CascadeKind kind, double energy, RandomStream& random);

}  // namespace floe

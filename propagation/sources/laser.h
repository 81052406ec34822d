// Light on a cone from one place: calibration lasers whose beam a conical mirror spreads.
//
// IceCube's standard candles are pulsed nitrogen lasers of 337 nm; one of them stands on string 40, 1813 m
// below the surface, and shines up. A reflecting cone spreads the light at the Cherenkov angle, so that it
// looks like a cascade of known energy; filters let 0.5% to 100% of it through.
#pragma once

#include <optional>

#include "geometry/acceptance.h"
#include "propagation/sources/measured_curve.h"
#include "propagation/sources/quantile_table.h"
#include "propagation/sources/source.h"

namespace floe {

inline constexpr double nitrogen_laser_wavelength = 337;  // [nm]

// Angle of Cherenkov light to its particle at a wavelength: arccos(1/n) [rad], 41.1 degrees at 337 nm.
double cherenkov_angle(double wavelength);

struct LaserSettings {
  Vec3 position = Vec3::Zero();                   // [m]
  double time = 0;                                // of the flash [ns]
  double photons = 0;                             // N, as a nominal module would accept them; >= 0
  double wavelength = nitrogen_laser_wavelength;  // of all photons [nm], 300 to 600
  Vec3 axis = Vec3::UnitZ();                      // of the cone; light travels away from its tip
  double opening = 0;                             // between axis and light [rad], 0 to pi; 0: a pencil
  bool isotropic = false;                         // into all directions alike, without cone
  std::optional<MeasuredCurve> pulse = {};        // from `time` on; none: all light at once
};

// All photons start at one place; azimuths about the axis are even.
class LaserSource : public Source {
 public:
  // Throws UsageError for settings out of range.
  explicit LaserSource(const LaserSettings& settings);
  double photons() const override { return settings_.photons; }
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const override;

 private:
  LaserSettings settings_;
  std::optional<QuantileTable> pulse_times_;
};

// Of photons of one wavelength that leave a source, the share that N counts: the acceptance of a nominal
// module, its area included. It follows from the spectrum of accepted Cherenkov light (a density p over
// wavelengths of photons_per_metre photons a metre) and the Frank-Tamm yield of a bare track:
// photons_per_metre p(w) / (2 pi alpha (1 - 1/n^2) / w^2).
double accepted_share(double wavelength, const WavelengthSpectrum& spectrum);

}  // namespace floe

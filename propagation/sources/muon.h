// A muon between two of its large losses: a line of Cherenkov light.
#pragma once

#include "geometry/acceptance.h"
#include "propagation/sources/quantile_table.h"
#include "propagation/sources/source.h"

namespace floe {

struct MuonSegment {
  Vec3 position = Vec3::Zero();    // where it begins [m]
  double time = 0;                 // there [ns]
  double zenith = 0, azimuth = 0;  // where the muon comes FROM [rad]
  double length = 0;               // [m], >= 0; without length there is no light
  double energy = 0;               // [GeV], > 0
};

// Light of the small losses along a muon's track, relative to that of the bare track: (0.1880 +
// 0.0206 ln(E/GeV)) x 0.910/0.9216 (arXiv:1210.5140), not below 0. Losses above some 500 MeV are not in it:
// they are cascades of their own.
double small_losses(double energy);

// Light from a place even along the segment, at the time when the muon is there at the speed of light. That
// of the bare track lies on the Cherenkov cone; that of the small losses has the angles of showers. The
// energy is taken for constant along the segment.
class MuonSource : public Source {
 public:
  // Throws UsageError unless energy > 0 and length >= 0, both finite.
  MuonSource(const MuonSegment& muon, const WavelengthSpectrum& spectrum);
  double photons() const override;
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const override;

 private:
  MuonSegment muon_;
  Vec3f start_, axis_;
  QuantileTable wavelengths_, cherenkov_angles_, particle_angles_;
  float bare_share_;  // of the light: the bare track's
};

}  // namespace floe

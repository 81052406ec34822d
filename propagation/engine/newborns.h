// Photons that are born, many at a time, and wait for a lane.
#pragma once

#include <cstdint>

#include "propagation/engine/walker.h"
#include "propagation/engine/wavelength_table.h"

namespace floe {

// Photons number first .. first + count - 1 of a run.
struct Newborns {
  static constexpr int count = EmittedPhotons::count;

  std::uint64_t first = 0;
  std::uint64_t walked = 0;  // as bits, photon `first` the lowest: those that are walked at all
  EmittedPhotons photons;
  RandomStreams streams;
  alignas(64) float absorption_depth[count];  // optical depth to absorption
  alignas(64) float scattering_power[count], absorption_dust[count], absorption_thermal[count];
  alignas(64) float slowness[count];  // see WavelengthTable
};

// Fills `newborns` with photons of the batch from number `first` on; those beyond its end are not walked.
void bear_photons(const Source& source, const PhotonBatch& batch, const WavelengthTable& wavelengths,
                  std::uint64_t first, Newborns& newborns);

}  // namespace floe

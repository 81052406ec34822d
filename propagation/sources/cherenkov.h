// Angles of Cherenkov light: what cascades and muons share.
#pragma once

#include "geometry/acceptance.h"
#include "propagation/engine/directions.h"
#include "propagation/engine/random.h"
#include "propagation/sources/quantile_table.h"

namespace floe {

// The parametrisations of arXiv:1210.5140 were made for a density of 0.910 g/cm3; the ice has 0.9216.
inline constexpr double density_ratio = 0.910 / 0.9216;

// 1 - cos of the angle between a shower's axis and the particle that emits, against a uniform number u:
// (-ln(1 - u I)/b)^(1/a), a = 0.39, b = 2.61, I = 1 - exp(-b 2^a) (arXiv:1210.5140).
QuantileTable shower_particle_angles();

// 1 - cos of the Cherenkov angle of particles at the speed of light, cos = 1/n, against the uniform number
// from which the spectrum draws the photon's wavelength.
QuantileTable cherenkov_angles(const WavelengthSpectrum& spectrum);

// Turns an axis to the photon's direction: to the particle that emits, at `particle_angle`, and from there to
// the Cherenkov cone about it (both 1 - cos), at two random azimuths.
inline void turn_to_photon(RandomStreams& random, int i, float particle_angle, float cherenkov_angle,
                           float& nx, float& ny, float& nz) {
  const TurnFunctions<float> around_axis = turn_functions(random.uniform(i));
  deflect(particle_angle, around_axis.cosine, around_axis.sine, nx, ny, nz);
  const TurnFunctions<float> around_particle = turn_functions(random.uniform(i));
  deflect(cherenkov_angle, around_particle.cosine, around_particle.sine, nx, ny, nz);
}

}  // namespace floe

// What the boundary between two grains does to a ray of light: the plain version, to be read.
//
// Source: arXiv:1908.07608 and The Cryosphere 18, 75 (2024): the tangential wave vector is the same on both
// sides (phase matching), and so are the tangential components of E and H (Maxwell), which the incident wave,
// two reflected and two refracted waves share out. Any of the four may be evanescent.
#pragma once

#include <array>

#include "propagation/crystal/plane_wave.h"

namespace floe {

// A photon inside a grain: a plane wave of one polarisation, whose energy travels along `direction`.
struct CrystalRay {
  Vec3 axis;       // c-axis of the grain
  Vec3 k;          // wave vector, in units of the vacuum's wave number
  Vec3 direction;  // of the energy, a unit vector
  Polarisation polarisation = Polarisation::ordinary;
};
CrystalRay ray_along(const Vec3& direction, const Vec3& axis, Polarisation polarisation,
                     const CrystalIndices& indices);

struct OutgoingWave {
  bool reflected;
  Polarisation polarisation;
  ComplexVec3 k;
  std::complex<double> amplitude;  // of fields_of(), where the incident wave has amplitude 1
  double share;                    // of the energy that crosses the boundary; 0 of evanescent waves
};
// Reflected ordinary, reflected extraordinary, refracted ordinary, refracted extraordinary. `normal`: unit
// vector with normal . incident.direction > 0. `axis_behind`: c-axis of the grain on the other side.
std::array<OutgoingWave, 4> outgoing_waves(const CrystalRay& incident, const Vec3& normal,
                                           const Vec3& axis_behind, const CrystalIndices& indices);

// The ray that leaves the boundary: one of these waves, drawn by its share with `uniform` in (0, 1).
CrystalRay cross_boundary(const CrystalRay& incident, const Vec3& normal, const Vec3& axis_behind,
                          double uniform, const CrystalIndices& indices);

}  // namespace floe

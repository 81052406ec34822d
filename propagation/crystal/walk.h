// The walk of photons through polycrystalline ice: grain after grain of birefringent crystal.
//
// At the end of each step a photon meets a boundary (grain_shape.h), behind which a grain lies whose c-axis
// is drawn from the fabric; the outgoing wave is drawn by its share of the energy (boundary.h). It moves
// along its energy flow. A reflected photon stays in its grain and meets that grain's next boundary. Source:
// arXiv:1908.07608; The Cryosphere 18, 75 (2024).
#pragma once

#include <cstdint>
#include <vector>

#include "data/base/progress.h"
#include "data/base/vec3.h"
#include "propagation/crystal/fabric.h"
#include "propagation/crystal/grain_shape.h"
#include "propagation/crystal/ice_crystal.h"

namespace floe {

struct Polycrystal {
  CrystalIndices indices;
  Fabric fabric;
  GrainShape grains;
};

struct CrystalWalk {
  double angle = 0;      // between the photon's first direction and the flow [rad], 0 to pi/2
  int crossings = 1000;  // boundaries it meets, reflections counted
  double step = 1e-3;    // between two of them [m]
};

// A photon at its end, relative to its start: components along x, towards the nearer flow direction and
// across its first direction n; y = n cross x; and n. (Where n lies along the flow, x is any axis across.)
struct WalkedPhoton {
  Vec3 direction;  // of its energy
  Vec3 position;   // [m]
};

// The stream of random numbers of a photon: a function of these alone.
struct PhotonStream {
  std::uint64_t seed, pattern, photon;
};

// One photon, in double precision, with all four waves of every boundary (boundary.h).
WalkedPhoton walk_plainly(const Polycrystal& crystal, const CrystalWalk& walk, const PhotonStream& stream);

// The photons first, first + 1, ... of a pattern, in this order, on `threads` cores (0: all): the same walk
// from the same random numbers by closed forms, many photons at once. The result depends neither on the
// number of threads nor on how the photons are shared out to calls.
std::vector<WalkedPhoton> walk_photons(const Polycrystal& crystal, const CrystalWalk& walk,
                                       const PhotonStream& first, std::size_t count, int threads,
                                       const Progress& progress = {});

}  // namespace floe

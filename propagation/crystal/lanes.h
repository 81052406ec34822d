// Many photons of the walk side by side, for loops that become vector code; one lane a photon.
#pragma once

#include <array>

#include "propagation/crystal/walk.h"
#include "propagation/engine/random.h"

namespace floe {

struct alignas(64) CrystalLanes {
  static constexpr int count = RandomStreams::count;

  RandomStreams streams;
  // The photon's ray, as in CrystalRay; ordinary: 1 or 0.
  double kx[count], ky[count], kz[count], ax[count], ay[count], az[count];
  double dx[count], dy[count], dz[count], ordinary[count];
  double px[count], py[count], pz[count];  // position [m]

  // The boundary that it meets next: normal, c-axis behind, and the draw that chooses the wave.
  double nx[count], ny[count], nz[count], bx[count], by[count], bz[count], choice[count];
  // Whether the c-axis was kept, and whether the boundary has to be left to the plain version.
  double kept[count], left_over[count];
};

// The loops' constants, by value.
struct LaneConstants {
  double square_ordinary;              // n_o^2
  double inverse_ordinary;             // 1/n_o^2
  double inverse_extraordinary;        // 1/n_e^2
  std::array<double, 3> axes;          // of the grains
  std::array<double, 3> scale, rates;  // of the fabric
  double keep;
  bool keeps_all;
};
LaneConstants lane_constants(const Polycrystal& crystal);

// Moves all photons by a step and draws the boundaries' normals and a c-axis behind each, once: in lanes that
// are not `kept` it has to be drawn again.
void draw_boundaries(CrystalLanes& lanes, double step, const LaneConstants& constants);

// Draws the choice and crosses the boundary in all lanes where no wave is evanescent; the others are
// `left_over`, unchanged but for their choice.
void cross_boundaries(CrystalLanes& lanes, const LaneConstants& constants);

}  // namespace floe

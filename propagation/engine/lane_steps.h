// The parts of a walk's step that all lanes take together; compiled to vector code.
#pragma once

#include "geometry/clearance_map.h"
#include "propagation/engine/ice_view.h"
#include "propagation/engine/lanes.h"

namespace floe {

// Draws every lane's optical depth to its next scatter.
void draw_scattering_depths(Lanes& lanes);

// From height, direction and optical depths: the straight segment to the next scatter or to absorption,
// through all layers it crosses. Spends both depths.
void find_segments(const IceView& ice, Lanes& lanes);

// Lanes as bits, lane 0 the lowest: whose segments are long enough to meet a module, and whose photons are
// absorbed at their end.
struct LaneSets {
  std::uint64_t may_meet, absorbed;
};
LaneSets find_reach(const ClearanceMap::View& clearance, Lanes& lanes);

// To the segment's end, and through the birefringent step there.
void advance(const IceView& ice, Lanes& lanes);

// Into a new direction.
void scatter(const IceView& ice, Lanes& lanes);

// One lane's segment again, at most `limit` metres of it.
struct LanePiece {
  float length, scattering_depth, absorption_depth;  // the depths left at its end
  float diffusion, deflection;
  std::int32_t layer;
};
LanePiece piece_of_segment(const IceView& ice, const Lanes& lanes, int lane, float limit);

}  // namespace floe

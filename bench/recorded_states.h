// States of photons as they come up in a real walk, for timing the parts of a step on.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/clearance_map.h"
#include "propagation/engine/lanes.h"
#include "propagation/engine/simulator.h"

namespace floe {

// A straight segment that a module may be on.
struct RecordedSegment {
  Vec3f origin, direction;
  float length;
  std::uint32_t nearest_module;
};

struct RecordedStates {
  // The same moments of a step: at its beginning; with depths and heights, before the layers are walked
  // through; with the segment found, before it is gone.
  std::vector<Lanes> begun, drawn, found;
  // Segments on which only the nearest module may be, and those on which others may be, too.
  std::vector<RecordedSegment> near_one, near_more;
};

// Walks photons of the source through the ice, each until it is absorbed, no module in the way.
RecordedStates record_states(const Model& model, const Source& source, const ClearanceMap& clearance);

}  // namespace floe

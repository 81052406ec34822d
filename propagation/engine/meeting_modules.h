// What both walkers say of a photon that meets modules.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/module_scene.h"

namespace floe {

// Along the path, to the emitting module at its nominal size; infinite where the path does not lead there.
// Asked for apart from the finder: whoever is close by may already be inside the widened shape.
inline float distance_home(const Vec3f& emitting_module, const Vec3f& origin, const Vec3f& direction,
                           float length) {
  ModuleCrossing crossing{};
  return cross_module(emitting_module, 1, origin, direction, length, crossing)
             ? crossing.distance
             : std::numeric_limits<float>::infinity();
}

// Photons whose absorption is stretched by k survive the optical depth d with exp(-d/k): they count as what
// makes exp(-d) of it.
inline float weight_of_stretched(double absorption_depth, double stretch) {
  return static_cast<float>(std::exp(-absorption_depth * (1 - 1 / stretch)));
}

}  // namespace floe

// Which modules does a straight segment of a photon's path meet? Answered by Embree: every module is
// a ray-oriented disc of the widened radius; a filter function collects all discs on the segment.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/detector.h"

namespace floe {

// A segment's encounter with a widened module ("pancake": widened by the oversize X only across the
// photon's direction). With b the distance along the ray to the closest approach to the centre and
// d the distance from the centre there, the photon lands at t = b - sqrt(R^2 - (d/X)^2), when
// 0 < t <= length.
struct ModuleCrossing {
  std::uint32_t module;  // index in Detector::modules()
  float distance;        // t along the segment [m]
  // From the landing point to the module's centre, on the module of nominal size: unit vector. It is
  // what remains after the across-part of the offset is scaled by 1/X.
  Vec3f inward;
};

// Interface, so that the same tests and the same engine run over interchangeable parts.
class ModuleFinder {
 public:
  virtual ~ModuleFinder() = default;
  // Appends to `found` every module met by the segment, nearest first (equal distances by index).
  // `direction` is a unit vector, length >= 0 [m]. Safe to call from many threads.
  virtual void find(const Vec3f& origin, const Vec3f& direction, float length,
                    std::vector<ModuleCrossing>& found) const = 0;
};

// The crossing of a segment with one widened module, in closed form; what every finder must agree with.
bool cross_module(const Vec3f& centre, float oversize, const Vec3f& origin, const Vec3f& direction,
                  float length, ModuleCrossing& crossing);

// Tries every module in turn: the plain version. Both throw UsageError unless 1 <= oversize <= 100.
// Modules that are off stand in the way like all others.
std::unique_ptr<ModuleFinder> make_exhaustive_finder(const Detector& detector, double oversize);
// Embree's ray-oriented discs with a filter function.
std::unique_ptr<ModuleFinder> make_embree_finder(const Detector& detector, double oversize);

}  // namespace floe

// Which modules does a straight segment of a photon's path meet? Answered by Embree: every module is
// a ray-oriented disc of the widened radius; a filter function collects all discs on the segment.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
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

// Tries every module in turn: the plain version.
std::unique_ptr<ModuleFinder> make_exhaustive_finder(const Detector& detector, double oversize);
// Embree's ray-oriented discs with a filter function. Throws UsageError unless 1 <= oversize <= 100.
std::unique_ptr<ModuleFinder> make_embree_finder(const Detector& detector, double oversize);

// A lower bound of the distance [m] a photon may walk from a point, in any direction, before it can
// meet any widened module: tabulated on a grid, never larger than the truth.
class ClearanceMap {
 public:
  ClearanceMap(const Detector& detector, double oversize);
  float operator()(const Vec3f& position) const;

 private:
  // A horizontal grid of distances to the nearest string, and the vertical span of the modules.
  std::vector<float> distance_;
  int columns_ = 0, rows_ = 0;
  float x0_ = 0, y0_ = 0, cell_ = 0, per_cell_ = 0;
  float top_ = 0, bottom_ = 0;
};

}  // namespace floe

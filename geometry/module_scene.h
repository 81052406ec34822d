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

// A lower bound of the distance [m] a photon may walk from a point, in any direction and through any
// number of scatters, before it can meet any widened module: tabulated on a grid, never larger than the
// truth, 0 near modules. A widened module of oversize X is met within X module radii of its centre.
class ClearanceMap {
 public:
  // Throws UsageError unless 1 <= oversize <= 100.
  ClearanceMap(const Detector& detector, double oversize);

  float operator()(const Vec3f& position) const {
    const float aside = horizontal(position.x(), position.y());
    const float above = outside(position.z(), low_.z(), high_.z());
    return std::max(0.0F, std::sqrt(aside * aside + above * above) - reach_);
  }

 private:
  static constexpr float step = 0.25F;       // of the tabulated distances [m]
  static constexpr float farthest = 63.75F;  // tabulated [m]

  // Distance of a coordinate to an interval.
  static float outside(float x, float low, float high) { return std::max({low - x, x - high, 0.0F}); }

  // Lower bound of the horizontal distance to the nearest module's centre.
  float horizontal(float x, float y) const {
    const float column = (x - x0_) * per_cell_, row = (y - y0_) * per_cell_;
    if (column >= 0 && row >= 0 && column < static_cast<float>(columns_) && row < static_cast<float>(rows_))
      return step * distance_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
    const float dx = outside(x, low_.x(), high_.x()), dy = outside(y, low_.y(), high_.y());
    return std::sqrt(dx * dx + dy * dy);
  }
  void lay_out_grid();
  void enter_column(float x, float y);

  // Of each grid cell, by row: distance from its nearest point to the nearest module, in steps, rounded
  // down. One byte a cell, so that the table stays in the cache.
  std::vector<std::uint8_t> distance_;
  std::size_t columns_ = 0, rows_ = 0;
  float x0_ = 0, y0_ = 0, cell_ = 0, per_cell_ = 0;
  Vec3f low_, high_;  // extent of the modules' centres
  float reach_ = 0;   // of a widened module, and what rounding may cost [m]
};

}  // namespace floe

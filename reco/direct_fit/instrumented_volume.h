// Is a point among the modules?
#pragma once

#include <vector>

#include "geometry/detector.h"

namespace floe {

// Upright prism over the convex hull of the strings, as high as the modules.
class InstrumentedVolume {
 public:
  explicit InstrumentedVolume(const Detector& detector);
  // Distance to the prism [m]; 0 inside.
  double distance_outside(const Vec3& position) const;

 private:
  std::vector<Eigen::Vector2d> hull_;  // anticlockwise
  double low_, high_;
};

}  // namespace floe

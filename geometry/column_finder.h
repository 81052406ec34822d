// The modules of one column that a segment meets, in closed form: what to ask when no other column is in
// reach, which is cheaper than a search of the whole detector.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/module_columns.h"
#include "geometry/module_scene.h"

namespace floe {

// Immutable.
class ColumnFinder {
 public:
  // Throws UsageError unless 1 <= oversize <= 100.
  ColumnFinder(const Detector& detector, double oversize);

  // Appends what the segment meets of the column in which `module` hangs, nearest first; as
  // ModuleFinder::find() otherwise. The nearer in height that module is to the segment, the faster.
  void find(std::uint32_t module, const Vec3f& origin, const Vec3f& direction, float length,
            std::vector<ModuleCrossing>& found) const;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Place {
    Vec3f centre;
    float column_radius;
    std::uint32_t above, below;  // the neighbours in the column, or none
  };

  float oversize_;
  float reach_;  // of a module, along and across the segment, and what rounding may cost [m]
  std::vector<Place> places_;
};

}  // namespace floe

// How patterns grow with the number of crossings. Propagation takes it that widths grow with the square root
// and deflections linearly (arXiv:2107.08692), as they do when every crossing turns light a little and
// forgets what was before.
#pragma once

#include <vector>

#include "propagation/crystal/pattern_grid.h"

namespace floe {

// One number of the pattern of a shorter path, over what the law makes of it from the longest path's.
struct ScalingCheck {
  double angle;  // [rad]
  int crossings;
  PatternNumber number;
  Estimate ratio;  // 1 where the law holds

  // Off by more than 3 errors and by more than a twentieth.
  bool fails() const;
};

// For each of the grid's angles, paths of 1/100, 1/10 and 1/3 of its crossings (at least 10): core widths,
// and the core's mean deflection where it is known to a tenth. `patterns`: those of the grid itself.
std::vector<ScalingCheck> check_scaling(const PatternGrid& grid, const std::vector<CrystalPattern>& patterns,
                                        const Progress& progress = {});

}  // namespace floe

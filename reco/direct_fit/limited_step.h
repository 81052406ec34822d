// A step that must stay in a region.
#pragma once

#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

// How much of `step`, the solution of equations with this `slope`, stays within |step| <= `most` (each number
// of its own): combinations that `information` tells well go all the way, the others as far as the region
// reaches (Levenberg 1944, Quarterly of Applied Mathematics 2, 164). All of it where it lies inside; scaled
// where `information` is not positive definite. `most` > 0.
Vector7 limited_step(const Vector7& step, const Matrix7& slope, const Matrix7& information,
                     const Vector7& most);

}  // namespace floe

// What the calibrated score simulates around a point: a wide design to teach the weights and slopes, a narrow
// one to say what the weighted sums mean there. Theory: docs/theory/direct_fit.md.
#pragma once

#include "reco/direct_fit/design.h"
#include "reco/event_data.h"

namespace floe {

// Light changes within a fraction of the way to a module that sees much of it: steps must not be wider [m].
double widest_step(const EventData& data, const LightCentre& light);

struct CalibrationStages {
  Stage wide, narrow;
};
// One draw of each fold; photons are to be filled in. Steps follow the errors of place [m] and direction
// [rad] as far as they are known by now.
CalibrationStages calibration_stages(double position_error, double direction_error, double widest_step,
                                     double oversize);

}  // namespace floe

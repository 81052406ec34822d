// What the calibrated score simulates around a point: a wide design to teach the weights and slopes, a narrow
// one to say what the weighted sums mean there. Theory: docs/theory/direct_fit.md.
#pragma once

#include "reco/direct_fit/design.h"
#include "reco/event_data.h"

namespace floe {

// Light changes within a fraction of the way to a module that sees much of it: steps must not be wider [m].
double widest_step(const EventData& data, const LightCentre& light);

// training_oversize(oversize), but modules of that size must not reach over that fraction, either.
double training_oversize(const EventData& data, const LightCentre& light, double oversize);
// Of rough steps: the same only where modules as wide as usual would reach over half of the way.
double rough_oversize(const EventData& data, const LightCentre& light, double oversize);

// How well a cascade is known.
struct PlaceErrors {
  double position = 0;   // [m]
  double direction = 0;  // [rad]
};
PlaceErrors place_errors(const Matrix7& covariance);  // of the local numbers

struct CalibrationStages {
  Stage wide, narrow;
};
// One draw of each fold, with steps that follow the errors, times `reach`; photons are to be filled in.
CalibrationStages calibration_stages(const EventData& data, const LightCentre& light,
                                     const PlaceErrors& errors, double reach, double oversize);

}  // namespace floe

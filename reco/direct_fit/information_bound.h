// The least errors that any unbiased fit of a cascade can have.
#pragma once

#include "reco/direct_fit/cascade_fit.h"

namespace floe {

// Cramer-Rao bound of x, y, z [m], time [ns], zenith, azimuth [rad], energy [GeV] at `truth`, for Poisson
// data of `event`'s modules: the inverse of the Fisher information of the same expectation as the fit's, with
// no model error and simulations without end. Costs about as much as a third of a fit; `options.effort`
// multiplies that. An upper limit that falls to the bound with the effort (see cramer_rao_bound of
// reco/direct_fit/calibrated_score.h). Infinite when the event leaves a combination open.
Matrix7 cramer_rao_bound(ExpectationModel& light, const CascadeParameters& truth, const Event& event,
                         const FitOptions& options);

}  // namespace floe

// The least errors that any unbiased fit of a cascade can have.
#pragma once

#include "reco/direct_fit/cascade_fit.h"

namespace floe {

// Cramer-Rao bound of x, y, z [m], time [ns], zenith, azimuth [rad], energy [GeV] at `truth`, for Poisson
// data: the inverse of the Fisher information of the same expectation as the fit's, with no model error and
// simulations without end. Of `data` it takes the modules and how much light there is. Costs about as much as
// a third of a fit; `options.effort` multiplies that; `count_into` is told of simulations and photons. An
// upper limit that falls to the bound with the effort (see cramer_rao_bound of
// reco/direct_fit/calibrated_score.h). Not finite when the event leaves a combination open.
Matrix7 cramer_rao_bound(ExpectationModel& light, const CascadeParameters& truth, const EventData& data,
                         const FitOptions& options, CascadeFit* count_into = nullptr);

// A covariance with errors of at least those of the bound, in all combinations of parameters; where the bound
// is not finite, as it was.
Matrix7 no_less_than(const Matrix7& bound, const Matrix7& covariance);

}  // namespace floe

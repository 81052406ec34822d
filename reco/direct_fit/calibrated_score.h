// The last step of a fit: seven sums over the data, and simulations that say what they mean.
// Theory: docs/theory/direct_fit.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reco/direct_fit/emulator.h"
#include "reco/direct_fit/score_likelihood.h"

namespace floe {

// An emulator gives every bin a weight for every parameter: its gradient over its variance. Seven sums of
// the data with these weights (the score) hold nearly all information. What the sums are expected to be as a
// function of the parameters is then measured with simulations that the emulator was not trained on, so that
// neither noise nor errors of the emulator's can bias the solution or pass for information; they only make
// the weights a little less than optimal. Two folds (each emulator against the other's simulations) use
// every simulation for both ends.
struct ScoreFold {
  Emulator emulator;
  std::vector<const LightSample*> training;  // what the emulator learnt from; not shared with the other fold
  std::vector<const LightSample*> fresh;     // near the origin, unknown to both emulators
};

struct ScoreSolution {
  Vector7 step = Vector7::Zero();  // from the emulators' origin
  Matrix7 covariance = Matrix7::Constant(std::numeric_limits<double>::infinity());  // data and simulation
  Matrix7 data_covariance = covariance;  // with simulations without end
  // Variance of the fresh simulations about their fit, 1 when they are Poisson counts: photons that hit
  // several modules and what the emulator cannot follow make it larger.
  double dispersion = 1;
  double weight_loss = std::numeric_limits<double>::infinity();  // of the weights; see InformationBound
  bool converged = false;
  bool leaves = false;  // the solution lies outside the trusted region; step leads to its edge
};

// Both emulators have the same origin, bins and settings; all must outlive the call. `position_error` [m]:
// how well the place is known by now.
ScoreSolution solve_calibrated_score(const EventData& data, std::span<const ScoreFold, 2> folds,
                                     double position_error);

// What the sums say around a solution that converged; `data` and `folds` must outlive it. `excess_scatter` >=
// 0: how much more than Poisson's the data's variance is.
ScoreLikelihood score_likelihood(const EventData& data, std::span<const ScoreFold, 2> folds,
                                 const ScoreSolution& solution, double position_error, double excess_scatter);

struct InformationBound {
  Matrix7 covariance = Matrix7::Constant(std::numeric_limits<double>::infinity());  // of the local numbers
  // Variance with these weights over that with perfect ones, in the combination of parameters where it is
  // the largest. Infinite where the weights are mostly noise; the covariance is then that of these weights.
  double weight_loss = std::numeric_limits<double>::infinity();
};

// The least covariance that any unbiased estimate of the local numbers can have, at the emulators' origin,
// when data are Poisson counts about the expectation (Cramer-Rao), from the information in the calibrated
// score. Noise in the weights loses information in proportion to 1/photons: the loss is read off the
// difference between one fold's weights and both folds' and taken out.
InformationBound cramer_rao_bound(const EventData& data, std::span<const ScoreFold, 2> folds);

}  // namespace floe

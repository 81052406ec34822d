// The last step of a fit: seven sums over the data, and simulations that say what they mean.
// Theory: docs/theory/direct_fit.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reco/direct_fit/emulator.h"

namespace floe {

// An emulator gives every bin a weight for every parameter: its gradient over its variance. Seven sums of
// the data with these weights (the score) hold nearly all information. What the sums are expected to be as a
// function of the parameters is then measured with simulations that the emulator was not trained on, so that
// neither noise nor errors of the emulator's can bias the solution or pass for information; they only make
// the weights a little less than optimal. Two folds (each emulator against the other's simulations) use
// every simulation for both ends.
struct ScoreFold {
  Emulator emulator;                      // the other fold's must not share its simulations
  std::vector<const LightSample*> fresh;  // near the origin, unknown to `emulator`; at least 7
};

struct ScoreSolution {
  Vector7 step = Vector7::Zero();  // from the emulators' origin
  Matrix7 covariance = Matrix7::Constant(std::numeric_limits<double>::infinity());  // data and simulation
  Matrix7 data_covariance = covariance;  // with simulations without end
  // Variance of the fresh simulations about their fit, 1 when they are Poisson counts: photons that hit
  // several modules and what the emulator cannot follow make it larger.
  double dispersion = 1;
  bool converged = false;
  bool leaves = false;  // the solution lies outside the trusted region; step leads to its edge
};

// Both emulators have the same origin, bins and settings; all must outlive the call.
ScoreSolution solve_calibrated_score(const EventData& data, std::span<const ScoreFold, 2> folds);

// The least covariance that any unbiased estimate of the local numbers can have, at the emulators' origin,
// when data are Poisson counts about the expectation (Cramer-Rao), from the information in the calibrated
// score. As the score's weights are noisy, this is an upper limit of the bound that falls to it with more
// simulations.
Matrix7 cramer_rao_bound(const EventData& data, std::span<const ScoreFold, 2> folds);

}  // namespace floe

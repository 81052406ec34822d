// Which of two models describes an event better: both are fitted, then measured with one rod.
#pragma once

#include <array>
#include <string>

#include "reco/direct_fit/cascade_fit.h"

namespace floe {

struct ModelComparison {
  std::string event;
  std::array<CascadeFit, 2> fits;  // A, B
  // B - A of the saturated negative log-likelihood, on the same bins, with equal numbers of photons and
  // the same seeds: positive when A describes the event better. The error is from the finite
  // simulations (jackknife over independent seeds).
  double delta_neg_llh = std::numeric_limits<double>::quiet_NaN();
  double delta_neg_llh_error = std::numeric_limits<double>::quiet_NaN();
  // B against A.
  double distance = 0;      // between vertices [m]
  double angle = 0;         // between axes [rad]
  double energy_ratio = 1;  // B / A

  // False when one of the fits has no result; then delta_neg_llh is not a number.
  bool usable() const { return fits[0].usable() && fits[1].usable(); }
};

// The two models must have the same modules at the same places (UsageError otherwise). B's fit begins at A's
// result, and moves from there as far as it wants to. Errors as in fit_cascade.
ModelComparison compare_models(const Model& a, const Model& b, const Event& event,
                               const FitOptions& options = {}, const Progress& progress = {});

}  // namespace floe

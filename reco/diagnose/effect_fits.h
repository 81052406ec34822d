// Fits of what may be added to a base model, each with the light that it needs.
#pragma once

#include <functional>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/stages.h"
#include "reco/ice_fit/ice_fit.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// All throw InputError where the way leads to no physical ice.
class EffectFits {
 public:
  // Keeps references; `data`: screened.
  EffectFits(const Model& base, const FlasherData& data, const RunSettings& settings, const Stages& stages)
      : base_(base), data_(data), settings_(settings), stages_(stages) {}

  // Ends a fit early (IceFitOptions).
  using Settled = std::function<bool(const IceFit&)>;

  IceFit fit(const std::vector<IceParameter>& parameters, const Settled& settled = {}) const;
  // Of layers, which follow one another slowly.
  IceFit fit_layers(const std::vector<IceParameter>& parameters) const;
  // To these runs only; with more light, since what they tell of the others is extrapolated, and the noise of
  // simulations with it.
  IceFit fit_to(const FlasherData& runs, const std::vector<IceParameter>& parameters) const;
  // Of rivals: where they are alike, noise of slopes and simulations decides soonest.
  IceFit fit_rivals(const std::vector<IceParameter>& parameters, const Settled& settled) const;

 private:
  IceFitOptions options(int rounds) const;
  IceFit fit(const FlasherData& runs, const std::vector<IceParameter>& parameters, int rounds, double light,
             const Settled& settled = {}) const;

  const Model& base_;
  const FlasherData& data_;
  RunSettings settings_;
  const Stages& stages_;
};

}  // namespace floe

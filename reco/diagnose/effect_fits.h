// Fits of what may be added to a base model, each with the light that it needs.
#pragma once

#include <functional>
#include <optional>
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
  // Fits that each leave runs out (fit_ice_without); with more light, since what the others tell of these is
  // extrapolated, and the noise of simulations with it.
  std::vector<FitWithout> fit_without(const std::vector<std::vector<char>>& left_out,
                                      const std::vector<IceParameter>& parameters) const;
  // Of rivals: where they are alike, noise of slopes and simulations decides soonest.
  IceFit fit_rivals(const std::vector<IceParameter>& parameters, const Settled& settled) const;

 private:
  IceFitOptions options(int rounds) const;
  IceFit fit(const std::vector<IceParameter>& parameters, const IceFitOptions& asked) const;

  const Model& base_;
  const FlasherData& data_;
  RunSettings settings_;
  const Stages& stages_;
};

}  // namespace floe

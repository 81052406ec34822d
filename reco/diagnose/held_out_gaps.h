// How far runs are from what they would be if a model were true, each judged by a model that was fitted to
// others.
#pragma once

#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/accepted_effects.h"
#include "reco/diagnose/effect_fits.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/stages.h"
#include "reco/ice_fit/held_out_runs.h"
#include "reco/ice_fit/model_judge.h"
#include "reco/ice_fit/run_data.h"

namespace floe {

struct RunGap {
  std::string run;
  double before = 0, after = 0;  // deviance above what it would be on average if the model were true
};

struct Gaps {
  std::vector<double> of_runs;
  // Part of their sum that is due to what the runs that a model was fitted to do not tell of it (FitWithout).
  double unknown = 0;
  // Sentences on groups that the others could not be fitted without.
  std::vector<std::string> remarks = {};

  double total() const;
  // Of models that other runs tell of, or do not, alike.
  double known() const { return total() - unknown; }
};

class HeldOutGaps {
 public:
  // Keeps references. `settings`: with the light of the measurement; `stream` as ModelJudge has it; `folds`:
  // runs are held out in so many groups, 1: none are.
  HeldOutGaps(const Model& base, const FlasherData& data, const FirstLook& look, const RunSettings& settings,
              std::uint64_t stream, int folds, const EffectFits& fits);

  const Gaps& of_base() const { return of_base_; }
  // Of the sum, had the base been true.
  double scatter_of_base() const { return 2 * right_of_base_.scatter; }
  // Between sums of models that fit equally well.
  double noise_of_differences() const { return 2 * judge_.noise_of_differences(); }
  // Each run by a model whose effects were fitted to the runs of all groups but its own. `stages`: from here
  // to `to`.
  Gaps of(const AcceptedEffects& effects, Stages& stages, double from, double to) const;

  // Probability of so bad a fit of all runs, were the model true but for differences that raise -ln L by
  // `allowed`.
  double p_of_base(double allowed) const;
  double p_of(const Model& model, double allowed) const;

 private:
  // A model that was fitted to the runs of the other groups.
  struct GroupModel {
    Model model;
    double unknown = 0;
    bool is_fitted = true;
  };
  std::vector<GroupModel> fitted_without(const AcceptedEffects& effects) const;

  const Model& base_;
  const FlasherData& data_;
  const EffectFits& fits_;
  ModelJudge judge_;
  HeldOutRuns held_out_;
  std::vector<ModelJudge::Fit> fits_of_base_;
  ExpectedFit right_of_base_;
  Gaps of_base_;
};

}  // namespace floe

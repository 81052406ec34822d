// How far runs are from what they would be if a model were true, each judged by a model that was fitted to
// others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/held_out_runs.h"
#include "reco/ice_fit/model_judge.h"
#include "reco/ice_fit/run_data.h"

namespace floe {

struct RunGap {
  std::string run;
  double before = 0, after = 0;  // deviance above what it would be on average if the model were true
};

// By run.
std::vector<ModelJudge::Fit> fits_of(const Model& model, const FlasherData& data, const ModelJudge& judge);

// `fits`: of a model that nothing was fitted to; `after` is as `before`.
std::vector<RunGap> gaps_of(const FlasherData& data, const std::vector<ModelJudge::Fit>& fits);

// Sets `after`. `model_without(fold)`: fitted to the runs of all other folds.
void hold_out(const HeldOutRuns& held_out, const ModelJudge& judge,
              const std::function<Model(int fold)>& model_without, std::vector<RunGap>& gaps);

}  // namespace floe

// How well counts of all runs fit a survey's model, against what they would if nothing were missing.
#pragma once

#include <vector>

#include "reco/diagnose/survey.h"
#include "reco/ice_fit/model_judge.h"

namespace floe {

// -ln L of all runs together.
double total_neg_llh(const Survey& survey, const SurveyCounts& counts);

// Mean and standard deviation of total_neg_llh() over light that is drawn under the model. At least two
// draws.
struct ExpectedFit {
  double mean = 0, scatter = 0;
};
ExpectedFit expected_fit(const Survey& survey, const Draws& draws);

// The same of runs that were judged one by one.
double neg_llh_of(const std::vector<ModelJudge::Fit>& fits);
ExpectedFit right_fit(const std::vector<ModelJudge::Fit>& fits);

// Of differences between programs as large as the floor, everywhere: they are no gap.
double neg_llh_of_floor(const FlasherData& data, double floor);

// Of a -ln L at least as large, by chance: twice it is nearly a chi-square, and becomes one of the same mean
// and deviation when it is scaled.
double probability_of(double neg_llh, const ExpectedFit& right);

}  // namespace floe

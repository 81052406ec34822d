// How strong what a score named is, beyond first order.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "reco/diagnose/score_test.h"

namespace floe {

// By run, hits in the survey's bins.
using LightInBins = std::vector<Eigen::VectorXd>;

struct ScoreValues {
  Eigen::VectorXd amplitudes, errors;
};

// Amplitudes that light was simulated with, corrected by what the counts still miss in it: a score alone is
// off by more than its error as soon as an effect is strong. Newton's way with the slopes of the survey's
// model; by how much light turns out to change more or less along a step than these say, the next one is
// shorter or longer, and a step after which more is missing than before is halved. `light`: simulated with
// these amplitudes, with the same photons every time; its brightness is free. `score`: of these counts.
ScoreValues beyond_first_order(const Survey& survey, const TestedSuspect& suspect, SurveyCounts counts,
                               const Score& score,
                               const std::function<LightInBins(const Eigen::VectorXd& amplitudes)>& light);

}  // namespace floe

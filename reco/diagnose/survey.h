// What flasher data say about a model: light and its residuals in all bins of all runs, and how each possible
// change of the model would show in them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/model.h"
#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/photon_draws.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_likelihood.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// One possible change: slopes of ln(light) in the survey's bins are a column.
struct SurveyColumn {
  enum class Kind {
    parameter,
    string_efficiency,
    module_efficiency,
    string_time,
    string_x,
    string_y,
    string_z
  };
  Kind kind = Kind::parameter;
  std::size_t parameter = 0;  // of the list given, where the kind says so
  int string = 0, dom = 0;    // else the place
};

struct SurveyRun {
  std::string name;
  RunData data;
  RunBins bins;
  Eigen::Index first = 0;  // row of its first bin, of all runs' bins
  RunNuisances nuisances;
  double photons = 0;  // N of the simulation
  double scale = 1;    // expected counts of the data for one simulated hit
  double dispersion = 1, data_dispersion = 1;
  double model_error = 0;
  FoldedCounts counts;
  PhotonDraws draws;
  // Bins x columns, brightness and time zero projected out: from even, from odd photons. No photon has to do
  // with both, so that products of the two have no noise on average.
  std::array<Eigen::MatrixXd, 2> halves;
  // For scores: the halves, or their mean where the score's photons have nothing to do with them.
  std::array<Eigen::MatrixXd, 2> weights;
  Eigen::MatrixXd nuisance;  // bins x 2: slopes of ln(light) in ln(brightness) and time zero
  Eigen::ArrayXd expected, trust;
};

struct Survey {
  std::vector<SurveyRun> runs;
  std::vector<SurveyColumn> columns;
  Eigen::Index bins = 0;
  std::uint64_t photons = 0;  // propagated
  // As in ScoreSystem, over the columns.
  Eigen::MatrixXd information, noise;
};

// Of all runs: as measured, or drawn under the model.
using SurveyCounts = std::vector<FoldedCounts>;
SurveyCounts measured_counts(const Survey& survey);
SurveyCounts drawn_counts(const Survey& survey, std::uint64_t seed, std::uint64_t draw);
// How much light of the model itself a calibration draws.
struct Draws {
  int count = 300;
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores; the result does not depend on it
};

// By column: sum of weights times what the counts have above the expectation.
Eigen::VectorXd gap_of(const Survey& survey, const SurveyCounts& counts);
// -ln L by run, saturated, at the best brightness.
std::vector<double> neg_llh_of(const Survey& survey, const SurveyCounts& counts);
// By bin: counts of the data that the model expects.
Eigen::VectorXd expected_of(const Survey& survey);
// By bin: counts above the expectation, brightness and time zero of each run projected out.
Eigen::VectorXd residual_of(const Survey& survey, const SurveyCounts& counts);

struct SurveyPlan {
  const std::vector<IceParameter>& parameters;              // at their null values in the model
  double pair_reach = 1, pair_light = 0.25, one_sided = 4;  // see PairPlan
  // A little less than fits have: surveys have many pairs, and make them smooth all the same.
  double least_pair_hits = 0.75 * enough_pair_hits;
  std::uint64_t stream = 0;  // of each survey its own, counting from 0
  bool places = true;        // strings and modules, too
};

// `data`: screened; `look`: of the runs. Throws NoResult when no receiver sees enough to be compared.
Survey survey_data(const Model& model, const FlasherData& data, const FirstLook& look, const SurveyPlan& plan,
                   const RunSettings& settings, const Progress& progress = {});

}  // namespace floe

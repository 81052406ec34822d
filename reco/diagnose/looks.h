// Looks at a model: is anything missing, where, and what could it be?
#pragma once

#include <optional>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/contest.h"
#include "reco/diagnose/diagnosis_options.h"
#include "reco/diagnose/score_test.h"
#include "reco/diagnose/separation.h"
#include "reco/diagnose/stages.h"
#include "reco/diagnose/where.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// A look, and what came of it.
struct DiagnosisStep {
  double neg_llh = 0, expected = 0, scatter = 0;  // -ln L of all runs; mean and deviation if all were right
  double p_of_fit = 1;                            // of so bad a fit
  ScoreTest scores;
  Whereabouts where;
  std::vector<Separation> separations;  // of all that may become a group, each from each other
  std::vector<Trial> trials;            // of the leading suspects, the best first
  std::optional<size_t> added;          // of Diagnosis::effects; none: nothing was

  // Whether the fit or a score is worse than chance allows.
  bool shows_gap(const DiagnosisOptions& options) const;
  // Of everything tried.
  double p_value() const;
};

class Looks {
 public:
  // Keeps references. The first look of all takes those runs out of `data` that have no light to be compared.
  Looks(const Model& base, FlasherData& data, const DiagnosisOptions& options, Stages& stages);

  // `step`: counts the looks, from 0.
  DiagnosisStep look_at(const Model& model, int step);
  // Of the runs that are left.
  const FirstLook& first_look() const { return first_; }

 private:
  RunSettings settings() const;
  bool leave_out_dim_runs(const Survey& survey);
  void judge_fit(const Survey& survey, DiagnosisStep& look) const;

  FlasherData& data_;
  const DiagnosisOptions& options_;
  Stages& stages_;
  FirstLook first_;
};

}  // namespace floe

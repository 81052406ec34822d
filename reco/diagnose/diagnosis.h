// What a model is missing: where simulation and flasher data disagree, which effect of the catalogue closes
// the gap, and how much of it. Theory: docs/theory/diagnose.md.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/effects_file.h"
#include "propagation/model.h"
#include "reco/diagnose/accepted_effects.h"
#include "reco/diagnose/diagnosis_options.h"
#include "reco/diagnose/held_out_gaps.h"
#include "reco/diagnose/looks.h"
#include "reco/ice_fit/run_data.h"

namespace floe {

// Changes whenever results of diagnoses or of their trials do.
constexpr int diagnosis_revision = 18;

struct Diagnosis {
  std::vector<std::string> verdict;  // as in result.json
  double p_value = 1;                // of the base model, for everything tried
  std::vector<NamedEffect> effects;
  std::vector<DiagnosisStep> steps;  // the base model's first
  std::vector<RunGap> gaps;          // held out
  double gap_before = 0, gap_after = 0;
  double gap_scatter = 0;   // deviation of a gap, had the model been true
  double gap_unknown = 0;   // part of the gap after that is due to what runs do not tell of others (Gaps)
  double gap_of_floor = 0;  // that differences between programs as large as the floor would make
  // Groups that runs were held out in. 1: none were, and gaps after are of a model that was fitted to these
  // runs.
  int folds = 1;
  // Whether the last step looked at the improved model: not when names were given up after it.
  bool looked_at_improved = false;
  // Of so bad a fit of the improved model to all runs, measured with the light of gaps; of the base model
  // when everything that was added has been given up again. None: nothing was added.
  std::optional<double> p_of_rest;
  // Why the verdict ends with "unexplained" beside names, half a sentence each.
  std::vector<std::string> why_unexplained;
  std::vector<std::string> left_out;              // of the data, a sentence each
  std::map<std::string, std::string> not_tested;  // effects of the catalogue, and why
  std::vector<std::string> remarks;               // effects that were given up again
  Model improved;
  EffectGroups beside_ice;  // of the effects, those that no file of an ice directory can hold but floe.toml
  double seconds = 0;

  // A share that means something only where the gap is clear.
  double closed() const { return gap_before != 0 ? 1 - gap_after / gap_before : 0; }
  bool has_clear_gap() const { return is_clear(gap_before); }
  bool is_clear(double gap) const { return gap - gap_of_floor > 3 * gap_scatter; }
};

// Throws UsageError for options out of range, NoResult when no run has light.
Diagnosis diagnose(const Model& base, const FlasherData& data, const DiagnosisOptions& options,
                   const Progress& progress = {});

}  // namespace floe

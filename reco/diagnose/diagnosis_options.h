// What a diagnosis may be told.
#pragma once

#include "reco/diagnose/survey.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// What decides whether anything is named.
struct NamingOptions : RunSettings {
  double alpha = 0.01;   // probability of naming anything when nothing is missing
  double floor = 0.005;  // changes of light smaller than this, relative, are not told from differences
                         // between programs
  int folds = 3;         // groups of runs, each held out once; 1 to the number of flashers
  int draws = 300;       // of light under the model, for each calibration

  Draws calibration() const { return {draws, seed, threads}; }
  // Fits and scores may each name something, with half of the false alarms.
  double alpha_of_each() const { return alpha / 2; }
};

struct DiagnosisOptions : NamingOptions {
  DiagnosisOptions() { light = {2, 2e4, 2e11}; }
  int most_effects = 4;  // that are added, one after another
};

}  // namespace floe

// Blind trials of the diagnosis: an effect is drawn at random in kind, place and strength, light is simulated
// with it, and the diagnosis is asked what is missing. In the fast form that is the score test, and all
// trials share one survey of the base; in full it is everything (full_trials.h).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/base/progress.h"
#include "propagation/model.h"
#include "reco/diagnose/diagnosis_options.h"
#include "reco/diagnose/full_trials.h"
#include "reco/diagnose/hidden_draws.h"
#include "reco/diagnose/seen_above.h"
#include "reco/diagnose/trial_light.h"

namespace floe {

// `light` is that of the survey; whole diagnoses have their own. `folds` are theirs.
struct BlindTrialOptions : NamingOptions {
  // All trials share the noise of one survey: with twice the data's light, an unlucky one named the same
  // layer in 11 of 100 trials with nothing missing.
  BlindTrialOptions() { light = {10, 1e3, 2e11}; }
  std::vector<std::string> effects;  // to hide; none named: all that flashers tell of
  int trials = 3;                    // of each effect
  int nothing = 20;                  // trials with nothing missing
  int full = 0;          // of the effects hidden, so many are hidden again for the whole diagnosis
  int full_nothing = 0;  // whole diagnoses with nothing missing
  int pairs = 0;         // whole diagnoses of two effects hidden together
  int outside = 0;       // and of what the catalogue does not have (outside_effects.h)
  std::optional<double> full_least_hits = {};  // of theirs, LightBudget::least_hits
  SignificanceRange significance{5, 12};       // of what is hidden
  // Of the survey (see PairPlan): it serves all trials, so that its slopes may be good.
  double pair_light = 0.4;
};

struct BlindTrial {
  HiddenEffect hidden;
  double p_value = 1;
  NamedInTrial named;       // the first in the ranking
  double significance = 0;  // of what was named
  // Of effects that were named at their place, beside HiddenEffect::values; none of bands, whose depth and
  // width are told by a fit.
  std::vector<double> found, errors;

  bool right() const;
};

struct BlindTrials {
  std::vector<BlindTrial> trials;
  std::vector<FullTrial> full;
  std::vector<SeenAbove> power;
  std::map<std::string, std::string> not_tried;  // effects that no light of these runs shows, and why
  std::vector<std::string> remarks;              // fewer trials than were asked for, and why
  double seconds = 0;
};

// What an earlier run with the same options has found of the same trials, from the first one on: these are
// not run again. The others are handed out as soon as they end, in order.
struct TrialRecord {
  std::vector<BlindTrial> trials;
  std::vector<FullTrial> full;
  std::function<void(const BlindTrial&)> keep_trial;
  std::function<void(const FullTrial&)> keep_full;
  // Called with all that is hidden before anything is asked; what is asked is not given it.
  std::function<void(std::span<const HiddenEffect> trials, std::span<const std::vector<HiddenEffect>> full)>
      seal;
};

// `runs`: with photons, as flashers are simulated. Throws UsageError for options out of range.
BlindTrials run_blind_trials(const Model& base, const std::vector<RunOfTrials>& runs,
                             const BlindTrialOptions& options, const Progress& progress = {},
                             const TrialRecord& record = {});

}  // namespace floe

// Fits of the suspects that lead a look's ranking, each beside all that is in the model already.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/accepted_effects.h"
#include "reco/diagnose/contest.h"
#include "reco/diagnose/effect_fits.h"
#include "reco/diagnose/looks.h"
#include "reco/diagnose/stages.h"
#include "reco/ice_fit/model_judge.h"

namespace floe {

// What fits are made with. `accepted`: what is in the model already.
struct SuspectFits {
  const Model& base;
  const AcceptedEffects& accepted;
  const EffectFits& fits;
  const ModelJudge& judge;
  Stages& stages;
};

class LeadingSuspects {
 public:
  // Keeps references. `step`: of the look, from 0.
  LeadingSuspects(const SuspectFits& with, const DiagnosisStep& look, int step)
      : with_(with), look_(look), step_(step) {}

  // At most three, and the leader at another place where that explains nearly as much: the ranking's first
  // comes first. `remarks`: of those that could not be fitted.
  std::vector<Candidate> fit(std::vector<std::string>& remarks);
  // Whether fresh light shows a good part of what the score has promised.
  bool is_confirmed(const Trial& trial);

 private:
  bool is_worth_a_fit(const EffectScore& score, const Candidate* confirmed_leader);
  bool is_more_of_accepted(const EffectScore& score) const;
  void add_fitted(const Score& score, std::vector<Candidate>& candidates, std::vector<std::string>& remarks);
  Candidate fitted(const Score& score, double best) const;
  void judge(const Model& model, Candidate& candidate) const;
  double neg_llh_so_far();

  SuspectFits with_;
  const DiagnosisStep& look_;
  int step_;
  std::optional<double> neg_llh_so_far_;
};

}  // namespace floe

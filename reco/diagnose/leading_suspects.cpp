#include "reco/diagnose/leading_suspects.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/base/error.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/rivals.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {

namespace {

constexpr std::size_t most_trials = 3;
// Of the best chi-square so far, after two rounds and after more: the further a fit has come, the less it
// catches up. And of the chi-square that the score promises.
constexpr double hopeless_share = 0.3, hopeless_share_later = 0.7, hopeless_share_of_promise = 0.1;
constexpr double confirmed_share = 0.4;  // of the gain that the effect's best score promised, by a fit

}  // namespace

std::vector<Candidate> LeadingSuspects::fit(std::vector<std::string>& remarks) {
  std::vector<Candidate> candidates;
  std::size_t effects = 0;
  bool is_leader_confirmed = false;
  const EffectScore& leader = look_.scores.effects.front();
  for (const EffectScore& score : look_.scores.effects) {
    if (effects == most_trials || !is_worth_a_fit(score, is_leader_confirmed ? &candidates.front() : nullptr))
      continue;
    const double done = 0.4 + 0.4 * static_cast<double>(effects++) / most_trials;
    with_.stages.begin_in_step(step_, done, done + 0.13, "fitting " + text_of(score.best.suspect));
    add_fitted(score.best, candidates, remarks);
    if (&score != &leader) continue;
    is_leader_confirmed = !candidates.empty() && is_confirmed(candidates.front().trial);
    // The leader's place, too, is only the best of those that were tried.
    if (score.elsewhere && !with_.accepted.has(score.elsewhere->suspect))
      add_fitted(*score.elsewhere, candidates, remarks);
  }
  return candidates;
}

// Others than the leader have looks of their own once it is in the model.
bool LeadingSuspects::is_worth_a_fit(const EffectScore& score, const Candidate* confirmed_leader) {
  const EffectScore& leader = look_.scores.effects.front();
  if (!leads(score, leader) || with_.accepted.has(score.best.suspect) || is_more_of_accepted(score))
    return false;
  return !confirmed_leader ||
         is_alternative(score, leader, neg_llh_so_far() - confirmed_leader->trial.neg_llh,
                        confirmed_leader->left);
}

// What an effect that is in the model already would explain best must not go to what is like it.
bool LeadingSuspects::is_more_of_accepted(const EffectScore& score) const {
  constexpr double alike = 0.5;
  return with_.accepted.has(look_.scores.effects.front().best.suspect) && score.likeness > alike;
}

void LeadingSuspects::add_fitted(const Score& score, std::vector<Candidate>& candidates,
                                 std::vector<std::string>& remarks) {
  double best = 0;
  for (const Candidate& candidate : candidates) best = std::max(best, candidate.trial.chi_square);
  try {
    candidates.push_back(fitted(score, best));
  } catch (const InputError&) {
    remarks.push_back(
        fmt::format("{} could not be fitted: no physical ice on its way", text_of(score.suspect)));
  }
}

// `best`: chi-square of the best so far. A fit that stays far behind it, or what was promised, need not go
// on.
Candidate LeadingSuspects::fitted(const Score& score, double best) const {
  Candidate candidate;
  Trial& trial = candidate.trial;
  trial.suspect = score.suspect;
  trial.parameters = fit_parameters(score.suspect, score.amplitudes, with_.base);
  const std::size_t first = with_.accepted.parameter_count();
  const auto chi_square = [&](const IceFit& fit) {
    return chi_square_of(trial.parameters, fit, first, with_.base);
  };
  const double promised = hopeless_share_of_promise * 2 * score.gain;
  candidate.fit = with_.fits.fit(with_.accepted.parameters(trial.parameters), [&](const IceFit& fit) {
    const double share = fit.rounds > 2 ? hopeless_share_later : hopeless_share;
    return chi_square(fit) < std::max(share * best, promised);
  });
  judge(with_parameters(with_.base, candidate.fit.parameters, candidate.fit.numbers), candidate);
  trial.chi_square = chi_square(candidate.fit);
  for (std::size_t i = 0; i < trial.parameters.size(); ++i) {
    trial.values.push_back(candidate.fit.value(first + i));
    trial.errors.push_back(candidate.fit.error(first + i));
  }
  return candidate;
}

void LeadingSuspects::judge(const Model& model, Candidate& candidate) const {
  // Standard deviations. Data that happen to be liked better than that tell no more of what is left.
  constexpr double at_most = 3, lucky = -1;
  const std::vector<ModelJudge::Fit> fits = with_.judge.judge_all(model);
  candidate.trial.neg_llh = neg_llh_of(fits);
  const ExpectedFit right = right_fit(fits);
  candidate.left =
      std::max(candidate.trial.neg_llh - right.mean, lucky * right.scatter) + at_most * right.scatter;
}

// The score chose the best of many suspects, and of noisy slopes: fresh light has to show a good part of it,
// in the fit or, since chi-squares about the model without the effect are short of what it gains where its
// slopes change on the way, in what it gains.
bool LeadingSuspects::is_confirmed(const Trial& trial) {
  constexpr double by_chance = 0.01;
  if (chi_square_probability(trial.chi_square, static_cast<double>(trial.parameters.size())) > by_chance)
    return false;
  const double wanted = confirmed_share * look_.scores.of(trial.suspect.effect).best.gain;
  return trial.chi_square / 2 > wanted ||
         neg_llh_so_far() - trial.neg_llh > wanted + 2 * with_.judge.noise_of_differences();
}

// Of the model with all that is in it already.
double LeadingSuspects::neg_llh_so_far() {
  if (!neg_llh_so_far_) neg_llh_so_far_ = with_.judge.neg_llh(with_.accepted.model());
  return *neg_llh_so_far_;
}

}  // namespace floe

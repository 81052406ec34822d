#include "reco/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>
#include <utility>

#include "data/base/error.h"
#include "propagation/effects/effect.h"
#include "reco/diagnose/additions.h"
#include "reco/diagnose/effect_fits.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/leading_suspects.h"
#include "reco/diagnose/looks.h"
#include "reco/diagnose/measured_gaps.h"
#include "reco/diagnose/rivals.h"
#include "reco/diagnose/stages.h"
#include "reco/diagnose/unexplained.h"
#include "reco/ice_fit/model_judge.h"

namespace floe {

namespace {

constexpr std::uint64_t judge_stream = std::uint64_t{1} << 45;

void check_options(const DiagnosisOptions& options, int flashers) {
  check(static_cast<const RunSettings&>(options));
  const auto require = [](bool right, const std::string& what) {
    if (!right) throw UsageError(what);
  };
  require(options.alpha > 0 && options.alpha < 1, "alpha must be between 0 and 1");
  require(options.floor >= 0 && options.floor < 1, "the floor must be between 0 and 1");
  require(options.draws >= 50, "calibrations need at least 50 draws");
  require(options.folds >= 1 && options.folds <= flashers,
          fmt::format("found {} folds; expected 1 to {}, the number of flashers", options.folds, flashers));
}

class Diagnoser {
 public:
  Diagnoser(const Model& base, FlasherData data, const DiagnosisOptions& options, const Progress& progress)
      : base_(base),
        data_(std::move(data)),
        options_(options),
        stages_(progress),
        looks_(base, data_, options, stages_),
        fits_(base, data_, options, stages_),
        additions_(base, fits_, result_),
        accepted_(additions_.accepted()) {}

  Diagnosis run() {
    bool unexplained = false;
    for (int step = 0;; ++step) {
      DiagnosisStep& now = look_at(accepted_.model(), step);
      if (step == 0) {
        result_.left_out = data_.left_out;
        judge_.emplace(base_, data_, looks_.first_look(), options_, judge_stream);
        result_.p_value = now.p_value();
      }
      const bool gap = now.shows_gap(options_);
      refusal_.clear();
      if (gap && add_effect(now, step)) continue;
      if (refine_what_waits()) continue;
      // Scores are valid whatever the slopes are: where no fit confirms the name, there is a gap without one.
      // Beside names they see what noise the fits of these have left.
      unexplained = step == 0 ? gap : now.p_of_fit < options_.alpha_of_each();
      break;
    }
    if (!refusal_.empty()) result_.remarks.push_back(refusal_);
    finish(unexplained);
    tell_what_was_not_tested();
    return std::move(result_);
  }

 private:
  DiagnosisStep& look_at(const Model& model, int step) {
    result_.steps.push_back(looks_.look_at(model, step));
    result_.looked_at_improved = true;
    return result_.steps.back();
  }

  // Fits the leading suspects and adds the best, when its fit confirms what its score said. Otherwise the
  // refusal says why: it holds as long as nothing else changes the model.
  bool add_effect(DiagnosisStep& now, int step) {
    if (now.scores.effects.empty() || now.scores.p_value >= options_.alpha_of_each()) return false;
    const Suspect& leader = now.scores.effects.front().best.suspect;
    const std::string suspected = fmt::format("(p = {:.2g})", now.scores.p_value);
    if (additions_.count() == options_.most_effects) {
      refusal_ = fmt::format("{} was suspected beside them {}; no more than {} effects are added",
                             text_of(leader), suspected, additions_.count());
      return false;
    }
    LeadingSuspects suspects({base_, accepted_, fits_, *judge_, stages_}, now, step);
    std::vector<Candidate> candidates = suspects.fit(result_.remarks);
    if (candidates.empty()) {
      refusal_ = accepted_.has(leader)
                     ? fmt::format("What stays looks like more of {}, not as it was fitted", text_of(leader))
                     : fmt::format("{} was suspected {}, too weakly for a fit", text_of(leader), suspected);
      return false;
    }
    const auto unconfirmed = std::stable_partition(
        candidates.begin(), candidates.end(),
        [&](const Candidate& candidate) { return suspects.is_confirmed(candidate.trial); });
    std::vector<Candidate> others(std::make_move_iterator(unconfirmed),
                                  std::make_move_iterator(candidates.end()));
    candidates.erase(unconfirmed, candidates.end());
    if (!candidates.empty()) choose(candidates, step);
    for (const auto* some : {&candidates, &others})
      for (const Candidate& candidate : *some) now.trials.push_back(candidate.trial);
    if (candidates.empty()) {
      refusal_ = fmt::format("{} was suspected {}, but no fit to fresh light confirms it",
                             text_of(now.trials.front().suspect), suspected);
      return false;
    }
    accept(now, candidates.front().fit);
    return true;
  }

  // The best comes first.
  void choose(std::vector<Candidate>& candidates, int step) {
    stages_.begin_in_step(step, 0.8, 1, "which of them is missing");
    hold_contest(
        base_, judge_->noise_of_differences(),
        [this](const auto& parameters, const auto& settled) {
          return fits_.fit_rivals(accepted_.parameters(parameters), settled);
        },
        candidates);
  }

  void accept(DiagnosisStep& now, const IceFit& fit) {
    const Trial& trial = now.trials.front();
    NamedEffect named;
    named.suspect = trial.suspect;
    named.parameters = trial.parameters;
    named.group = {trial.suspect.effect};
    for (const EffectScore& other : now.scores.effects)
      if (!accepted_.has(other.best.suspect) && cannot_be_told(other, now))
        named.group.push_back(other.best.suspect.effect);
    for (const Separation& separation : now.separations)
      if (separation.effect == named.group.front() && contains(named.group, separation.other))
        named.separations.push_back(separation);
    for (const Trial& rival : now.trials)
      if (rival.suspect.effect == trial.suspect.effect && lost_narrowly(rival))
        result_.remarks.push_back(
            fmt::format("{} can hardly be told from {}", text_of(rival.suspect), text_of(trial.suspect)));
    additions_.add(std::move(named), fit);
    layers_wait_ = true;
    // What else is missing hides what layers differ in, or is taken for it: asked again with every effect
    // that comes in, once none is known to be missing.
    const auto waits_for_a_look = [&](const EffectScore& effect) {
      return !accepted_.has(effect.best.suspect) && waits(effect, now.scores.effects.front());
    };
    if (std::ranges::none_of(now.scores.effects, waits_for_a_look)) refine_what_waits();
  }

  // Whether that has changed anything.
  bool refine_what_waits() {
    if (!std::exchange(layers_wait_, false)) return false;
    for (std::size_t e = 0; e < accepted_.effects().size(); ++e)
      if (accepted_.effects()[e].suspect.effect == "birefringence" && !accepted_.effects()[e].mean)
        return refine_by_layers(e);
    return false;
  }

  // Grains differ from layer to layer, and with them the strength of birefringence (arXiv:2107.08692).
  bool refine_by_layers(std::size_t birefringence) {
    const DepthRange range = layers_of(flasher_depths(data_, *base_.detector), flasher_count(data_));
    if (range.groups < 2) return false;
    stages_.begin(stages_.from(), stages_.to(), "fitting birefringence layer by layer");
    try {
      const IceFit layered =
          fits_.fit_layers(accepted_.parameters_by_layers(birefringence, LayerFamily::birefringence, range));
      const double least_spread = 2 * (range.groups - 1);
      if (accepted_.spread_of_layers(birefringence, layered) < least_spread) return false;
      additions_.take_layers(birefringence, layered);
      return true;
    } catch (const InputError&) {
      result_.remarks.push_back(
          "Birefringence has one strength for all layers: on the way to one for each, some layer scatters "
          "too little for so strong crystals");
      return false;
    }
  }

  // Whether this might as well be what is missing as the winner of the contest.
  static bool cannot_be_told(const EffectScore& other, const DiagnosisStep& now) {
    const std::string& effect = other.best.suspect.effect;
    if (effect == now.trials.front().suspect.effect) return false;
    for (const Trial& trial : now.trials)
      if (trial.suspect.effect == effect) return lost_narrowly(trial);  // fits decide where there are some
    // Likeness is known to the leader of the scores: who is like the leader, as the winner is, is alike.
    const EffectScore& leader = now.scores.effects.front();
    return is_inseparable(now.scores.of(now.trials.front().suspect.effect), leader) &&
           is_inseparable(other, leader);
  }

  void finish(bool unexplained) {
    measure_gaps({base_, data_, looks_.first_look(), options_, fits_, stages_, unexplained}, additions_,
                 result_);
    if (!accepted_.empty() && !result_.looked_at_improved)
      look_at(accepted_.model(), std::max(options_.most_effects + 1, static_cast<int>(result_.steps.size())));
    // A gap whose names were given up is there all the same.
    if (additions_.count() > 0)
      unexplained = unexplained || accepted_.empty() || *result_.p_of_rest < options_.alpha_of_each();
    result_.improved = accepted_.model();
    result_.effects = accepted_.effects();
    for (const NamedEffect& effect : result_.effects) result_.verdict.push_back(effect.suspect.effect);
    tell_apart_what_came_in();
    if (!accepted_.empty()) result_.why_unexplained = why_unexplained(result_, unexplained);
    if (unexplained || !result_.why_unexplained.empty()) result_.verdict.push_back("unexplained");
    result_.beside_ice = accepted_.beside_ice();
  }

  void tell_what_was_not_tested() {
    std::set<std::string> tested;
    for (const EffectScore& effect : result_.steps.front().scores.effects)
      tested.insert(effect.best.suspect.effect);
    for (const Effect* effect : effects())
      if (!tested.contains(effect->name()))
        result_.not_tested[effect->name()] = why_no_suspect(effect->name(), base_, options_.oversize);
  }

  // What is needed beside an effect is no alternative to it.
  void tell_apart_what_came_in() {
    for (const DiagnosisStep& step : result_.steps) {
      if (!step.added) continue;
      NamedEffect& winner = result_.effects[*step.added];
      const auto is_named_itself = [&](const std::string& other) {
        return other != winner.suspect.effect &&
               std::ranges::any_of(result_.effects, [&](const NamedEffect& effect) {
                 return effect.suspect.effect == other &&
                        is_same_place(effect.suspect.place, step.scores.of(other).best.suspect.place);
               });
      };
      std::erase_if(winner.group, is_named_itself);
      std::erase_if(winner.separations,
                    [&](const Separation& separation) { return is_named_itself(separation.other); });
    }
  }

  static bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  const Model& base_;
  FlasherData data_;
  const DiagnosisOptions& options_;
  Stages stages_;
  Looks looks_;
  std::optional<ModelJudge> judge_;  // of the runs that the first look has left
  EffectFits fits_;
  bool layers_wait_ = false;  // to be asked for, since an effect came in
  std::string refusal_;       // why the last look added none
  Diagnosis result_;
  Additions additions_;
  const AcceptedEffects& accepted_;
};

}  // namespace

Diagnosis diagnose(const Model& base, const FlasherData& data, const DiagnosisOptions& options,
                   const Progress& progress) {
  check_options(options, flasher_count(data));
  const auto start = std::chrono::steady_clock::now();
  Diagnosis result = Diagnoser(base, data, options, progress).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace floe

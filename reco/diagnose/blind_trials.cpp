#include "reco/diagnose/blind_trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>
#include <ranges>

#include "data/base/error.h"
#include "propagation/effects/effect.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/outside_effects.h"
#include "reco/diagnose/rivals.h"
#include "reco/diagnose/score_test.h"
#include "reco/diagnose/score_values.h"
#include "reco/ice_fit/held_out_runs.h"

namespace floe {

namespace {

// Far from the streams of surveys.
constexpr std::uint64_t data_stream = std::uint64_t{1} << 46, first_look_stream = data_stream + 1000,
                        trial_stream = std::uint64_t{1} << 47, full_stream = std::uint64_t{1} << 48,
                        outside_stream = std::uint64_t{1} << 49, value_stream = std::uint64_t{1} << 50;

class Trials {
 public:
  Trials(const Model& base, const std::vector<RunOfTrials>& runs, const BlindTrialOptions& options,
         const Progress& progress, const TrialRecord& record)
      : base_(base),
        runs_(runs),
        options_(options),
        progress_(progress),
        record_(record),
        light_(*base.detector, runs, options),
        random_(options.seed) {}

  BlindTrials run() {
    FlasherData data = light_.data_of(light_.hits(base_, data_stream));
    if (data.runs.size() != runs_.size())
      throw UsageError(fmt::format("trials need light of every run; {}", fmt::join(data.left_out, "; ")));
    const FirstLook look = look_first(
        base_,
        [this](std::size_t r, double photons) {
          RunRequest request = light_.request(r, first_look_stream);
          request.photons = photons;
          return request;
        },
        data);
    const SuspectPlan plan =
        plan_suspects(base_, flasher_depths(data, *base_.detector), flasher_count(data), options_.oversize);
    SurveyPlan survey_plan{.parameters = plan.parameters, .pair_light = options_.pair_light};
    const Survey survey = survey_data(base_, data, look, survey_plan, options_,
                                      [this](double fraction, const std::string& text) {
                                        if (progress_) progress_(0.3 * fraction, "survey: " + text);
                                      });
    const std::vector<Suspect> suspects = suspects_of(survey, plan);
    const ScoreTester tester(survey, suspects, plan.parameters, options_.calibration());

    result_.power = seen_above(tester, base_, options_.alpha_of_each(), options_.floor);
    const std::vector<Hidden> hidden = plan_trials(tester);
    const std::vector<Full> full = plan_full(hidden, survey);
    seal(hidden, full);
    // A whole diagnosis takes as long as many tests of scores.
    done_ = 0, all_ = static_cast<double>(hidden.size()) + per_full * static_cast<double>(full.size());
    run_each(hidden.size(), 1, record_.trials, record_.keep_trial, result_.trials, [&](std::size_t t) {
      report(0, fmt::format("trial {} of {}", t + 1, hidden.size()));
      return trial(hidden[t], t, survey, tester);
    });
    run_each(full.size(), per_full, record_.full, record_.keep_full, result_.full,
             [&](std::size_t t) { return diagnosed(full[t], t, full.size(), survey); });
    return std::move(result_);
  }

 private:
  // What a whole diagnosis is given.
  struct Full {
    std::vector<HiddenEffect> hidden;
    Model model;
    std::optional<FlasherData> outside;  // light with what no model has
  };
  static constexpr double per_full = 60;  // in fast trials

  void seal(const std::vector<Hidden>& hidden, const std::vector<Full>& full) const {
    if (!record_.seal) return;
    std::vector<HiddenEffect> trials;
    std::vector<std::vector<HiddenEffect>> whole;
    for (const Hidden& h : hidden) trials.push_back(h.effect);
    for (const Full& f : full) whole.push_back(f.hidden);
    record_.seal(trials, whole);
  }

  // Those that are known are taken as they are. `each`: of the progress, in fast trials.
  template <typename Result, typename Run>
  void run_each(std::size_t count, double each, const std::vector<Result>& known,
                const std::function<void(const Result&)>& keep, std::vector<Result>& results,
                const Run& run) {
    for (std::size_t t = 0; t < count; ++t, done_ += each) {
      results.push_back(t < known.size() ? known[t] : run(t));
      if (t >= known.size() && keep) keep(results.back());
    }
  }

  void report(double share_of_full, const std::string& text) const {
    if (progress_) progress_(0.3 + 0.7 * (done_ + share_of_full * per_full) / all_, text);
  }

  // Effects in turn, so that few of them are of many kinds.
  std::vector<Full> plan_full(const std::vector<Hidden>& hidden, const Survey& survey) {
    std::vector<const Hidden*> effects;
    for (const Hidden& h : hidden)
      if (!h.effect.effect.empty()) effects.push_back(&h);
    std::shuffle(effects.begin(), effects.end(), random_);
    std::map<std::string, int> seen;
    std::map<const Hidden*, int> turn;
    for (const Hidden* h : effects) turn[h] = seen[h->effect.effect]++;
    std::stable_sort(effects.begin(), effects.end(),
                     [&](const Hidden* a, const Hidden* b) { return turn[a] < turn[b]; });
    std::vector<Full> plan;
    for (int t = 0; t < options_.full && t < static_cast<int>(effects.size()); ++t) {
      const Hidden& h = *effects[static_cast<std::size_t>(t)];
      plan.push_back({{h.effect}, h.model, {}});
    }
    tell_shortage(options_.full, plan.size(), "one effect", "are hidden in the trials: more trials would do");
    for (int t = 0; t < options_.full_nothing; ++t) plan.push_back({{{}}, base_, {}});
    const std::size_t before_pairs = plan.size();
    for (int t = 0; t < options_.pairs; ++t)
      if (auto pair = draw_pair(effects)) plan.push_back(std::move(*pair));
    tell_shortage(options_.pairs, plan.size() - before_pairs, "two effects",
                  "were found that make physical ice together and are of two kinds");
    if (options_.outside == 0) return plan;
    const ExpectedFit right = expected_fit(survey, options_.calibration());
    std::vector<FlasherRun> flashers;
    for (const RunOfTrials& run : runs_) flashers.push_back(run.run);
    for (int t = 0; t < options_.outside; ++t)
      if (auto outside = draw_outside(t, flashers, survey, right)) plan.push_back(std::move(*outside));
    for (const Full& full : plan)
      if (full.outside) result_.not_tried.erase(full.hidden.front().effect);
    return plan;
  }

  void tell_shortage(int wanted, std::size_t found, const char* what, const char* why) {
    if (static_cast<int>(found) < wanted)
      result_.remarks.push_back(
          fmt::format("{} whole diagnoses of {} were asked for, and {} {}", wanted, what, found, why));
  }

  // As visible as other effects have to be.
  std::optional<Full> draw_outside(int number, const std::vector<FlasherRun>& flashers, const Survey& survey,
                                   const ExpectedFit& right) {
    constexpr int tries = 10;
    const TrialLight::Hits whole =
        light_.hits(base_, outside_stream + static_cast<std::uint64_t>(number) * runs_.size(), &survey);
    for (int i = 0; i < tries; ++i) {
      const OutsideEffect outside = draw_outside_effect(number, *base_.detector, flashers, random_);
      TrialLight::Hits hits = whole;
      for (std::size_t r = 0; r < runs_.size(); ++r) outside.apply(hits[r], flashers[r], random_);
      const double significance =
          (total_neg_llh(survey, light_.counts_of(hits, survey)) - right.mean) / right.scatter;
      if (significance > options_.significance.least)
        return Full{{{outside.name, outside.text, {}, significance}}, base_, light_.data_of(hits)};
      result_.not_tried[outside.name] =
          fmt::format("not seen at {} standard deviations: {}", options_.significance.least, outside.text);
    }
    return {};
  }

  // The second is applied to what the first leaves.
  std::optional<Full> draw_pair(const std::vector<const Hidden*>& effects) {
    constexpr int tries = 100;
    for (int i = 0; i < tries && effects.size() > 1; ++i) {
      std::uniform_int_distribution<std::size_t> any(0, effects.size() - 1);
      const Hidden &a = *effects[any(random_)], &b = *effects[any(random_)];
      if (a.effect.effect == b.effect.effect) continue;
      try {
        return Full{{a.effect, b.effect}, with_parameters(a.model, b.parameters, b.numbers), {}};
      } catch (const Error&) {
        // Together they make no physical ice: another pair.
      }
    }
    return {};
  }

  FullTrial diagnosed(const Full& full, std::size_t number, std::size_t count, const Survey& survey) {
    const FlasherData data =
        full.outside ? *full.outside
                     : light_.data_of(light_.hits(full.model, full_stream + number * runs_.size(), &survey));
    DiagnosisOptions options;
    LightBudget light = options.light;
    if (options_.full_least_hits) light.least_hits = *options_.full_least_hits;
    static_cast<NamingOptions&>(options) = options_;
    options.light = light;
    // Another survey for each: an unlucky one would mislead them all.
    options.seed = options_.seed * 1000003 + number + 1;
    options.folds = std::min(options_.folds, flasher_count(data));
    return full_trial(base_, full.hidden, full.outside.has_value(), data, options,
                      [&](double fraction, const std::string& text) {
                        report(fraction, fmt::format("diagnosis {} of {}: {}", number + 1, count, text));
                      });
  }

  bool is_wanted(const std::string& effect) const {
    const auto& wanted = options_.effects;
    return wanted.empty() || std::ranges::find(wanted, effect) != wanted.end();
  }
  using ByEffect = std::map<std::string, std::vector<const TestedSuspect*>>;
  void expect_known(const ByEffect& by_effect) const {
    for (const std::string& effect : options_.effects)
      if (!by_effect.count(effect))
        throw UsageError(
            fmt::format("flashers of this model tell nothing of {} that could be hidden; they do of {}",
                        effect, fmt::join(std::views::keys(by_effect), ", ")));
  }

  void tell_what_has_no_place(const ByEffect& by_effect) {
    if (options_.trials == 0) return;
    for (const Effect* effect : effects())
      if (is_wanted(effect->name()) && !by_effect.contains(effect->name()))
        result_.not_tried[effect->name()] = why_no_suspect(effect->name(), base_, options_.oversize);
  }

  // Of each effect some, and of nothing.
  std::vector<Hidden> plan_trials(const ScoreTester& tester) {
    ByEffect by_effect;
    for (const TestedSuspect& suspect : tester.suspects())
      by_effect[suspect.suspect->effect].push_back(&suspect);
    expect_known(by_effect);
    std::vector<Hidden> all;
    for (const auto& [effect, places] : by_effect) {
      if (!is_wanted(effect)) continue;
      int hid = 0;
      for (int t = 0; t < options_.trials; ++t)
        if (auto hidden = draw_hidden(places, tester, base_, options_.significance, random_))
          all.push_back(std::move(*hidden)), ++hid;
      if (hid == 0 && options_.trials > 0)
        result_.not_tried[effect] =
            fmt::format("these runs do not show it at {} standard deviations", options_.significance.least);
    }
    tell_what_has_no_place(by_effect);
    for (int t = 0; t < options_.nothing; ++t) all.push_back({{}, {}, {}, base_});
    return all;
  }

  BlindTrial trial(const Hidden& hidden, std::size_t number, const Survey& survey,
                   const ScoreTester& tester) const {
    const SurveyCounts counts =
        light_.counts_of(light_.hits(hidden.model, trial_stream + number * runs_.size(), &survey), survey);
    const ScoreTest test = tester.test(counts, options_.floor);
    BlindTrial trial;
    trial.hidden = hidden.effect;
    trial.p_value = test.p_value;
    if (test.effects.empty() || test.p_value >= options_.alpha_of_each()) return trial;
    const EffectScore& first = test.effects.front();
    const Suspect& suspect = first.best.suspect;
    trial.named = {suspect.effect, text_of(suspect), suspect.place, {}};
    trial.significance = sigmas_of(first.ln_p);
    if (trial.named.text == hidden.effect.text && !suspect.place.count("depth"))
      tell_values(first.best, counts, number, survey, tester, trial);
    for (const EffectScore& effect : test.effects)
      if (&effect == &first || is_inseparable(effect, first))
        trial.named.group.push_back(effect.best.suspect.effect);
    return trial;
  }

  void tell_values(const Score& score, const SurveyCounts& counts, std::size_t number, const Survey& survey,
                   const ScoreTester& tester, BlindTrial& trial) const {
    const std::vector<IceParameter> parameters = changing_parameters(score.suspect, base_);
    const auto numbers_at = [&](const Eigen::VectorXd& amplitudes) {
      std::vector<double> numbers;
      for (const IceParameter& p : parameters)
        numbers.push_back(
            p.within(null_number(p, base_) + amplitudes(static_cast<Eigen::Index>(numbers.size()))));
      return numbers;
    };
    const auto light = [&](const Eigen::VectorXd& amplitudes) {
      return light_.in_bins(with_parameters(base_, parameters, numbers_at(amplitudes)),
                            value_stream + number * runs_.size(), survey);
    };
    ScoreValues values{score.amplitudes, score.errors};
    try {
      values = beyond_first_order(survey, tester.tested(score.suspect), counts, score, light);
    } catch (const InputError&) {
      // No physical ice on the way: to first order.
    }
    trial.found = numbers_at(values.amplitudes);
    trial.errors.assign(values.errors.begin(), values.errors.end());
  }

  const Model& base_;
  const std::vector<RunOfTrials>& runs_;
  const BlindTrialOptions& options_;
  const Progress& progress_;
  const TrialRecord& record_;
  const TrialLight light_;
  std::mt19937_64 random_;
  BlindTrials result_;
  double done_ = 0, all_ = 1;  // in fast trials, for the progress bar
};

}  // namespace

bool BlindTrial::right() const {
  return hidden.effect.empty() ? named.effect.empty() : named.is(hidden);
}

BlindTrials run_blind_trials(const Model& base, const std::vector<RunOfTrials>& runs,
                             const BlindTrialOptions& options, const Progress& progress,
                             const TrialRecord& record) {
  check(static_cast<const RunSettings&>(options));
  if (runs.empty()) throw UsageError("blind trials need at least one flasher run");
  if (!(options.significance.least > 0 && options.significance.most >= options.significance.least))
    throw UsageError("significances must be positive, the smaller one first");
  for (const std::string& effect : options.effects) find_effect(effect);  // throws for those that are none
  const auto start = std::chrono::steady_clock::now();
  BlindTrials result = Trials(base, runs, options, progress, record).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace floe

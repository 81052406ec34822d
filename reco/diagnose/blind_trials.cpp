#include "reco/diagnose/blind_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "data/base/error.h"
#include "reco/diagnose/score_test.h"

namespace floe {

namespace {

constexpr std::size_t largest_group = 3;
// Far from the streams of surveys.
constexpr std::uint64_t data_stream = std::uint64_t{1} << 46, trial_stream = std::uint64_t{1} << 47;

RunRequest request_of(const FlasherRun& run, const RunSettings& settings, std::uint64_t stream) {
  return {run, run.photons, settings.oversize, settings.seed, stream, settings.threads};
}

class Trials {
 public:
  Trials(const Model& base, const std::vector<FlasherRun>& runs, const BlindTrialOptions& options,
         const Progress& progress)
      : base_(base), runs_(runs), options_(options), progress_(progress), random_(options.seed) {}

  BlindTrials run() {
    FlasherData data = light_of_base();
    const FirstLook look = look_first(
        base_,
        [this](std::size_t r, double photons) {
          RunRequest request = request_of(runs_[r], options_, data_stream + 1000 + r);
          request.photons = photons;
          return request;
        },
        data);
    const SuspectPlan plan = plan_suspects(base_, flasher_depths(data, *base_.detector), data.runs.size());
    SurveyPlan survey_plan{
        .parameters = plan.parameters, .pair_light = options_.pair_light, .turns_by_pairs = true};
    const Survey survey = survey_data(base_, data, look, survey_plan, options_,
                                      [this](double fraction, const std::string& text) {
                                        if (progress_) progress_(0.3 * fraction, "survey: " + text);
                                      });
    const std::vector<Suspect> suspects = suspects_of(survey, plan);
    const ScoreTester tester(survey, suspects, plan.parameters, options_.draws, options_.seed);

    result_.power = power(tester);
    const std::vector<HiddenEffect> hidden = draw_hidden(tester);
    for (std::size_t t = 0; t < hidden.size(); ++t) {
      if (progress_)
        progress_(0.3 + 0.7 * static_cast<double>(t) / static_cast<double>(hidden.size()),
                  fmt::format("trial {} of {}", t + 1, hidden.size()));
      result_.trials.push_back(trial(hidden[t], models_[t], t, survey, tester));
    }
    return std::move(result_);
  }

 private:
  FlasherData light_of_base() const {
    std::vector<Event> events;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      Event event;
      event.id = fmt::format("{},{}", runs_[r].module.string, runs_[r].module.dom);
      event.flasher = runs_[r];
      event.flasher->oversize = options_.oversize;
      for (const SimulatedHit& hit :
           simulate_run(base_, request_of(runs_[r], options_, data_stream + r)).hits)
        event.hits.push_back(to_hit(hit, *base_.detector));
      events.push_back(std::move(event));
    }
    return flasher_data(*base_.detector, events);
  }

  // What changes with the suspect's amplitudes: all parameters but the place of a band.
  std::vector<IceParameter> changing_parameters(const Suspect& suspect) const {
    const auto none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(suspect.amplitudes.size()));
    std::vector<IceParameter> parameters = fit_parameters(suspect, none, base_);
    std::erase_if(parameters, is_place_of_band);
    return parameters;
  }

  std::vector<SeenAbove> power(const ScoreTester& tester) const {
    std::map<std::string, std::vector<double>> changes;
    std::map<std::string, std::vector<IceParameter>> of_effect;  // alike at all places
    std::vector<SeenAbove> all;
    for (const TestedSuspect& tested : tester.suspects()) {
      const Suspect& suspect = *tested.suspect;
      const double gain = tester.gain_to_be_named(suspect.effect, options_.alpha);
      const auto [known, is_new] = of_effect.try_emplace(suspect.effect);
      if (is_new) known->second = changing_parameters(suspect);
      const std::vector<IceParameter>& parameters = known->second;
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        const double of_one = tested.expected_gain(Eigen::VectorXd::Unit(tested.low.size(), index));
        if (!(of_one > 0)) continue;
        std::vector<double>& of_parameter = changes[parameters[i].name];
        if (of_parameter.empty()) all.push_back({suspect.effect, parameters[i].name, parameters[i].unit, 0});
        of_parameter.push_back(std::sqrt(gain / of_one));
      }
    }
    for (SeenAbove& seen : all) {
      std::vector<double>& values = changes.at(seen.parameter);
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                       values.end());
      seen.change = values[values.size() / 2];
      // Amplitudes of bands are logarithms of their factors.
      if (seen.effect.ends_with("-layer")) seen.change = std::expm1(seen.change);
    }
    return all;
  }

  // Of each effect some, at places drawn at random, as strong as wanted and as its parameters allow.
  std::vector<HiddenEffect> draw_hidden(const ScoreTester& tester) {
    std::map<std::string, std::vector<const TestedSuspect*>> by_effect;
    for (const TestedSuspect& suspect : tester.suspects())
      by_effect[suspect.suspect->effect].push_back(&suspect);
    std::vector<HiddenEffect> all;
    for (const auto& [effect, places] : by_effect)
      for (int t = 0; t < options_.trials; ++t) {
        HiddenEffect hidden;
        Model model;
        if (hide(places, hidden, model)) {
          all.push_back(std::move(hidden));
          models_.push_back(std::move(model));
        } else {
          result_.not_tried[effect] =
              fmt::format("these runs do not show it at {} standard deviations", options_.least);
        }
      }
    for (int t = 0; t < options_.nothing; ++t) {
      all.emplace_back();
      models_.push_back(base_);
    }
    return all;
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  bool hide(const std::vector<const TestedSuspect*>& places, HiddenEffect& hidden, Model& model) {
    constexpr int tries = 40;
    for (int i = 0; i < tries; ++i) {
      const auto index = std::uniform_int_distribution<std::size_t>(0, places.size() - 1)(random_);
      const TestedSuspect& place = *places[index];
      Eigen::VectorXd direction(place.low.size());
      for (double& value : direction) value = std::normal_distribution<double>()(random_);
      const double wanted = uniform(options_.least, options_.most);
      const double unit = std::sqrt(2 * place.expected_gain(direction));
      if (!(unit > 0)) continue;
      const Eigen::VectorXd amplitudes = direction * wanted / unit;
      if (((amplitudes - place.low).array() < 0).any() || ((place.high - amplitudes).array() < 0).any())
        continue;
      try {
        const auto parameters = fit_parameters(*place.suspect, amplitudes, base_);
        if (!reaches(place, parameters, amplitudes)) continue;
        std::vector<double> numbers;
        hidden = {place.suspect->effect, text_of(*place.suspect), {}, wanted};
        for (const IceParameter& p : parameters) {
          numbers.push_back(p.start);
          hidden.values.emplace_back(p.name, p.start);
        }
        model = with_parameters(base_, parameters, numbers);
        return true;
      } catch (const Error&) {
        // No physical ice: another draw.
      }
    }
    return false;
  }

  // Parameters may be cut off at what makes sense.
  bool reaches(const TestedSuspect& place, const std::vector<IceParameter>& parameters,
               const Eigen::VectorXd& amplitudes) const {
    if (place.suspect->place.count("depth")) return std::abs(amplitudes(0)) < std::log(2.5);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double is = parameters[i].start - null_number(parameters[i], base_),
                   wanted = amplitudes(static_cast<Eigen::Index>(i));
      if (std::abs(is - wanted) > 0.05 * std::abs(wanted)) return false;
    }
    return true;
  }

  BlindTrial trial(const HiddenEffect& hidden, const Model& model, std::size_t number, const Survey& survey,
                   const ScoreTester& tester) const {
    SurveyCounts counts = measured_counts(survey);
    for (std::size_t r = 0; r < survey.runs.size(); ++r) {
      const RunData& data = survey.runs[r].data;
      RunRequest request = request_of(data.run, options_, trial_stream + number * survey.runs.size() + r);
      request.noise = noise_window(data, request.photons);
      const SimulatedRun light = simulate_run(model, request);
      counts[r].data.setZero();
      for (const SimulatedHit& hit : light.hits)
        if (const int bin = survey.runs[r].bins.bin(hit.module, hit.time); bin >= 0) counts[r].data(bin) += 1;
    }
    const ScoreTest test = tester.test(counts, options_.floor);
    BlindTrial trial;
    trial.hidden = hidden;
    trial.p_value = test.p_value;
    if (test.effects.empty() || test.p_value >= options_.alpha) return trial;
    const EffectScore& first = test.effects.front();
    trial.named = first.best.suspect.effect;
    trial.named_text = text_of(first.best.suspect);
    trial.significance = sigmas_of(first.ln_p);
    if (trial.named_text == hidden.text && !first.best.suspect.place.count("depth"))
      tell_values(first.best, trial);
    for (const EffectScore& effect : test.effects)
      if (&effect == &first || effect.likeness > inseparable)
        trial.group.push_back(effect.best.suspect.effect);
    return trial;
  }

  void tell_values(const Score& score, BlindTrial& trial) const {
    const std::vector<IceParameter> parameters = changing_parameters(score.suspect);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      trial.found.push_back(null_number(parameters[i], base_) + score.amplitudes(index));
      trial.errors.push_back(score.errors(index));
    }
  }

  const Model& base_;
  const std::vector<FlasherRun>& runs_;
  const BlindTrialOptions& options_;
  const Progress& progress_;
  std::mt19937_64 random_;
  std::vector<Model> models_;
  BlindTrials result_;
};

}  // namespace

bool BlindTrial::right() const {
  if (hidden.effect.empty()) return named.empty();
  return named == hidden.effect || (group.size() <= largest_group &&
                                    std::find(group.begin(), group.end(), hidden.effect) != group.end());
}

BlindTrials run_blind_trials(const Model& base, const std::vector<FlasherRun>& runs,
                             const BlindTrialOptions& options, const Progress& progress) {
  check(static_cast<const RunSettings&>(options));
  if (runs.empty()) throw UsageError("blind trials need at least one flasher run");
  if (!(options.least > 0 && options.most >= options.least))
    throw UsageError("significances must be positive, the smaller one first");
  const auto start = std::chrono::steady_clock::now();
  BlindTrials result = Trials(base, runs, options, progress).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace floe

#include "reco/diagnose/looks.h"

#include <algorithm>

#include "reco/diagnose/goodness.h"
#include "reco/diagnose/light_by_runs.h"
#include "reco/diagnose/rivals.h"
#include "reco/ice_fit/held_out_runs.h"

namespace floe {

namespace {

constexpr std::uint64_t look_stream = std::uint64_t{1} << 44;
constexpr double light_of_pairs = 0.12;  // for six runs, see light_by_runs.h; up to SurveyPlan's

// Of all that may become a group.
std::vector<Separation> separations_of(const Survey& survey, const std::vector<Axis>& axes,
                                       const ScoreTester& tester, const ScoreTest& scores) {
  std::vector<const Score*> rivals;
  for (const EffectScore& effect : scores.effects)
    if (is_inseparable(effect, scores.effects.front()) || leads(effect, scores.effects.front()))
      rivals.push_back(&effect.best);
  std::vector<Separation> separations;
  for (const Score* one : rivals)
    for (const Score* other : rivals)
      if (one != other)
        separations.push_back(separation(survey, axes, tester.difference(*one, other->suspect.effect),
                                         one->suspect.effect, other->suspect.effect));
  return separations;
}

}  // namespace

bool DiagnosisStep::shows_gap(const DiagnosisOptions& options) const {
  return scores.p_value < options.alpha_of_each() || p_of_fit < options.alpha_of_each();
}

double DiagnosisStep::p_value() const {
  return std::min(1.0, 2 * std::min(p_of_fit, scores.p_value));
}

Looks::Looks(const Model& base, FlasherData& data, const DiagnosisOptions& options, Stages& stages)
    : data_(data), options_(options), stages_(stages) {
  stages_.begin(0, 0.03, "first look");
  const auto request = [&](std::size_t r, double photons) {
    return request_of(data_.runs[r], options_, photons, look_stream + r);
  };
  first_ = look_first(base, request, data_);
  leave_out_dark_runs(data_, first_);
}

DiagnosisStep Looks::look_at(const Model& model, int step) {
  stages_.begin_in_step(step, 0, 0.4, step == 0 ? "looking for a gap" : "looking again");
  const SuspectPlan plan =
      plan_suspects(model, flasher_depths(data_, *model.detector), flasher_count(data_), options_.oversize);
  SurveyPlan survey_plan{.parameters = plan.parameters};
  survey_plan.stream = static_cast<std::uint64_t>(step);
  survey_plan.pair_light = light_by_runs(data_.runs.size(), light_of_pairs, survey_plan.pair_light);
  const Survey survey = survey_data(model, data_, first_, survey_plan, settings(), stages_.part());
  if (step == 0 && leave_out_dim_runs(survey)) return look_at(model, step);
  DiagnosisStep look;
  judge_fit(survey, look);
  const std::vector<Suspect> suspects = suspects_of(survey, plan);
  const ScoreTester tester(survey, suspects, plan.parameters, options_.calibration());
  look.scores = tester.test(measured_counts(survey), options_.floor);
  const std::vector<Axis> axes = axes_of(model, survey);
  look.where = where_is_the_gap(survey, axes, options_.calibration());
  look.separations = separations_of(survey, axes, tester, look.scores);
  return look;
}

// Few runs leave time for more light.
RunSettings Looks::settings() const {
  constexpr double least_in_all = 10;  // in units of the least hits of a run
  RunSettings settings = options_;
  settings.light.least_hits *= std::max(1.0, least_in_all / static_cast<double>(data_.runs.size()));
  return settings;
}

// They would count as flashers that tell of their ice. Whether there were any.
bool Looks::leave_out_dim_runs(const Survey& survey) {
  const std::size_t before = data_.runs.size();
  for (std::size_t r = before; r-- > 0;)
    if (survey.runs[r].bins.size() == 0)
      leave_out_run(r, "no receiver sees enough light to be compared", data_, first_);
  return data_.runs.size() < before;
}

void Looks::judge_fit(const Survey& survey, DiagnosisStep& look) const {
  look.neg_llh = total_neg_llh(survey, measured_counts(survey));
  const ExpectedFit right = expected_fit(survey, options_.calibration());
  look.expected = right.mean;
  look.scatter = right.scatter;
  look.p_of_fit = probability_of(look.neg_llh - neg_llh_of_floor(data_, options_.floor), right);
}

}  // namespace floe

// Flashers' light as a detector records it: noise, charges that differ, digitisers, pulses, averages over
// flashes. What a model lacks shows in it as in photons, and of the true model nothing shows.
#include <gtest/gtest.h>

#include <cmath>

#include "reco/diagnose/goodness.h"
#include "reco/diagnose/score_test.h"
#include "reco/diagnose/suspects.h"
#include "reco/ice_fit/held_out_runs.h"
#include "response/detector_response.h"

namespace floe::test {
namespace {

constexpr double flashes = 50;
constexpr std::uint64_t look_stream = std::uint64_t{1} << 50, data_stream = look_stream + 1010;

Model model_without(const std::vector<std::string>& effects) {
  ModelRequest request;
  request.without = effects;
  return load_model(request);
}

Event recorded_run(const Model& model, ModuleId flasher, std::uint64_t stream) {
  Event event;
  event.id = module_name(flasher);
  event.repeats = flashes;
  event.flasher.emplace();
  event.flasher->module = flasher;
  event.flasher->photons = 8e6;
  event.flasher->oversize = 16;
  RunRequest request{*event.flasher, flashes * event.flasher->photons, event.flasher->oversize};
  request.stream = stream;
  for (const SimulatedHit& simulated : simulate_run(model, request).hits) {
    Hit hit = to_hit(simulated, *model.detector);
    hit.charge = 1 / flashes;
    event.hits.push_back(hit);
  }
  ResponseSettings electronics;
  electronics.launches.mode = CoincidenceMode::none;
  return DetectorResponse(*model.detector, electronics, 1).respond(event, {}, 0).event;
}

class RecordedFlashes : public ::testing::Test {
 protected:
  RecordedFlashes() {
    const Model truth = model_without({});
    data_ = flasher_data(*truth.detector, std::vector{recorded_run(truth, {36, 20}, data_stream),
                                                      recorded_run(truth, {45, 40}, data_stream + 1)});
    settings_.light = {2, 1e3, 1e12};
  }
  Survey survey_of(const Model& base, const SurveyPlan& plan) {
    const FirstLook look = look_first(
        base,
        [&](std::size_t r, double photons) {
          return request_of(data_.runs[r], settings_, photons, look_stream + r);
        },
        data_);
    return survey_data(base, data_, look, plan, settings_);
  }
  RunSettings settings_;
  FlasherData data_;
};

TEST_F(RecordedFlashes, BirefringenceIsNamedWhereItIsMissing) {
  const Model base = model_without({"birefringence"});
  const SuspectPlan plan =
      plan_suspects(base, flasher_depths(data_, *base.detector), flasher_count(data_), 16);
  const Survey survey = survey_of(base, {.parameters = plan.parameters, .places = false});
  const std::vector<Suspect> suspects = suspects_of(survey, plan);
  const ScoreTest test =
      ScoreTester(survey, suspects, plan.parameters, Draws{200, 1}).test(measured_counts(survey), 0.005);
  ASSERT_FALSE(test.effects.empty());
  EXPECT_EQ(test.effects.front().best.suspect.effect, "birefringence")
      << text_of(test.effects.front().best.suspect);
  EXPECT_LT(test.p_value, 1e-4);
}

// Dark noise, 6% of the charge, is expected where it is: most modules see nothing else.
TEST_F(RecordedFlashes, AgreeWithTheTrueModel) {
  const std::vector<IceParameter> none;
  settings_.light.light = 4;
  const Survey survey = survey_of(model_without({}), {.parameters = none, .places = false});
  const ExpectedFit right = expected_fit(survey, {200, 1});
  EXPECT_NEAR(total_neg_llh(survey, measured_counts(survey)), right.mean, 3.5 * right.scatter);
  // In the light's brightness, too: as many photons as were emitted.
  for (const SurveyRun& run : survey.runs)
    EXPECT_NEAR(run.nuisances.brightness / (flashes * 8e6), 1, 0.1) << run.name;
}

}  // namespace
}  // namespace floe::test

// What a survey says of a change of the model, against light that is simulated with that change.
#include "reco/diagnose/survey.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>

#include "data/base/error.h"
#include "reco/diagnose/hidden_draws.h"
#include "reco/diagnose/score_test.h"
#include "reco/diagnose/seen_above.h"
#include "reco/diagnose/separation.h"
#include "reco/diagnose/suspects.h"
#include "reco/diagnose/trial_light.h"
#include "reco/ice_fit/ice_fit.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/model_judge.h"
#include "reco/ice_fit/run_scores.h"

namespace floe::test {
namespace {

constexpr std::uint64_t data_stream = std::uint64_t{1} << 50;

class OfOneFlasher : public ::testing::Test {
 protected:
  static constexpr double photons_ = 2e8;
  OfOneFlasher() {
    run_.module = {36, 20};
    run_.photons = photons_;
    run_.oversize = settings_.oversize;
    settings_.light = {4, 1e3, 1e12};
    data_ = data_of({event_of(model_, request(photons_, data_stream + 1))});
    look_ = look_first(
        model_, [&](std::size_t, double photons) { return request(photons, data_stream); }, data_);
  }
  RunRequest request(double photons, std::uint64_t stream) const {
    return {run_, photons, settings_.oversize, settings_.seed, stream, 0};
  }
  // Light as it is measured.
  Event event_of(const Model& model, const RunRequest& request) const {
    Event event;
    event.id = fmt::format("{},{}", run_.module.string, run_.module.dom);
    event.flasher = run_;
    for (const SimulatedHit& hit : simulate_run(model, request).hits)
      event.hits.push_back(to_hit(hit, *model_.detector));
    return event;
  }
  FlasherData data_of(const std::vector<Event>& events) const {
    return flasher_data(*model_.detector, events);
  }

  const Model model_ = load_model({});
  RunSettings settings_;
  FlasherRun run_;
  FlasherData data_;
  FirstLook look_;
};

// In the middle of much dark noise the brightness is that of the light, and bins are where light is.
TEST_F(OfOneFlasher, DarkNoiseIsNotTakenForLight) {
  constexpr double readouts = 100, length = 1e4, rate = 600;  // [ns], [Hz]
  RunRequest noisy = request(photons_, data_stream + 1);
  noisy.noise = {0, length, readouts / photons_, rate};
  FlasherData data = data_of({event_of(model_, noisy)});
  RunData& run = data.runs[0];
  run.repeats = readouts, run.noise_rate = rate, run.first = 0, run.last = length;
  const double light = data_.runs[0].charge, noise = run.charge - light;  // from the same photons
  ASSERT_GT(noise, 0.2 * light);
  const FirstLook look = look_first(
      model_, [&](std::size_t, double photons) { return request(photons, data_stream); }, data);
  EXPECT_NEAR(look.brightness[0] * look.hits_per_photon[0], light, 4 * std::sqrt(noise));

  const RunRequest with_noise = request_of(run, settings_, photons_, data_stream + 3, photons_);
  const RunRequest without = request(photons_, data_stream + 3);
  const Scout scout = scout_run(model_, with_noise, 0), of_light = scout_run(model_, without, 0);
  ASSERT_GT(scout.simulated.hits.size(), 1.2 * static_cast<double>(of_light.simulated.hits.size()));
  EXPECT_EQ(bins_of(scout, run, photons_).receivers().size(),
            bins_of(of_light, run, photons_).receivers().size());
}

// A survey with four times the light of the data has four times their dark noise, too.
TEST_F(OfOneFlasher, NoiseOfTrialsGoesWithTheirLight) {
  constexpr double more = 4;
  RunData run = data_.runs[0];
  run.repeats = 100, run.noise_rate = 600, run.first = 0, run.last = 1e4;
  const std::vector<RunOfTrials> runs{{run_, 1}};
  const TrialLight trials(*model_.detector, runs, settings_);
  Survey survey;
  survey.runs.emplace_back();
  survey.runs[0].data = run;
  survey.runs[0].photons = more * photons_;
  const std::vector<SimulatedHit> hits = trials.hits(model_, data_stream, &survey)[0];
  ASSERT_GT(double(hits.size()), 1.2 * run.charge);
  survey.runs[0].bins = RunBins(hits, 1, run.used, {});
  const double of_data = survey.runs[0].bins.counts(hits).sum();
  const double of_survey = trials.in_bins(model_, data_stream + 1, survey)[0].sum();
  // Widened modules see some photons more than once: counts scatter by a few per cent more than Poisson's.
  EXPECT_NEAR(of_survey, more * of_data, 4 * 1.1 * std::sqrt(more * of_data + more * more * of_data));
}

// Pulses that come a microsecond late are those of the same light: counts and slopes are as before.
TEST_F(OfOneFlasher, DelaysMoveSlopesWithTheirLight) {
  const std::vector<IceParameter> parameters{effect_parameter("absorption-scale", model_)};
  const IcePoint point(model_, parameters, {parameters[0].start}, run_.wavelength);
  const RunRequest at_once = request(photons_, data_stream + 4);
  RunRequest late = at_once;
  late.delays = {{1, 1000, 1000.001}};
  RunLight light[2];
  for (const bool is_late : {false, true}) {
    const RunRequest& asked = is_late ? late : at_once;
    const SimulatedRun simulated = simulate_run(model_, asked);
    const RunBins bins(simulated.hits, 1, data_.runs[0].used, {});
    light[is_late] = point.light(asked, simulated, bins, 0).light;
  }
  for (std::size_t fold = 0; fold < 2; ++fold) {
    const LightFold &before = light[0].folds[fold], &after = light[1].folds[fold];
    ASSERT_EQ(before.counts.size(), after.counts.size());
    // Times are rounded: a hit in a thousand may be in the next bin.
    EXPECT_LT((before.counts - after.counts).lpNorm<1>(), 1e-3 * before.counts.sum());
    EXPECT_LT((before.slopes - after.slopes).lpNorm<1>(), 1e-2 * before.slopes.lpNorm<1>());
  }
}

// A question is put from the second round on, and an answer ends the fit there.
TEST_F(OfOneFlasher, AFitEndsWhenItsQuestionIsSettled) {
  IceParameter scale = effect_parameter("absorption-scale", model_);
  scale.start = 1.3;
  scale.scale = 0.05;  // too short a way for four rounds
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.most_rounds = 4;
  options.judged = false;
  std::vector<double> asked;
  const auto fitted = [&](bool answer) {
    asked.clear();
    options.settled = [&](const IceFit& fit) {
      asked.push_back(fit.numbers[0]);
      return answer;
    };
    return fit_ice(model_, data_, {scale}, options);
  };
  const IceFit whole = fitted(false);
  EXPECT_EQ(whole.rounds, 4);
  ASSERT_EQ(asked.size(), 2u);  // nobody is asked after the last round
  EXPECT_LT(whole.numbers[0], asked[1]);
  const double after_two = asked[0];
  const IceFit ended = fitted(true);
  EXPECT_EQ(ended.rounds, 2);
  EXPECT_EQ(ended.numbers[0], after_two);
  EXPECT_FALSE(ended.converged);
}

// Whose clock is late is found, with the error that the light itself allows: of N hits whose times rise and
// fall over tens of nanoseconds.
TEST_F(OfOneFlasher, AFitFindsALateClock) {
  constexpr double late = 12;  // [ns]
  constexpr int string = 36;
  FlasherData data = data_;
  for (RunData::Pulse& pulse : data.runs[0].pulses)
    if (model_.detector->modules()[pulse.module].id.string == string) pulse.time += late;
  Suspect suspect;
  suspect.effect = "time-offset";
  suspect.place = {{"string", string}};
  suspect.amplitudes = {{{0, 1.0}}};
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.judged = false;
  const IceFit fit =
      fit_ice(model_, data, fit_parameters(suspect, Eigen::VectorXd::Zero(1), model_), options);
  EXPECT_NEAR(fit.value(0), late, 3 * fit.error(0));
  EXPECT_LT(fit.error(0), 2.5);
  EXPECT_GT(fit.error(0), 0.3);
}

// A string that moves across the line to the only flasher that it sees changes hardly any light. Slopes that
// were taken at their word led 9 m along the circle about the flasher, and were sure of that to 0.6 m.
TEST_F(OfOneFlasher, AFitDoesNotClaimWhatLightDoesNotShow) {
  constexpr int string = 80;
  constexpr std::size_t x = 0, y = 1;
  const auto place = [&](int of) -> Eigen::Vector2d {
    return model_.detector->modules()[*model_.detector->find({of, 20})].position.head<2>();
  };
  const Eigen::Vector2d along = (place(string) - place(36)).normalized();
  const Eigen::Vector2d across(-along(1), along(0));
  const Eigen::Vector2d truth = 1.5 * along;
  const Suspect suspect{"geometry-offset", {{"string", string}}, {{{0, 1.0}}, {{1, 1.0}}, {{2, 1.0}}}, 6};
  const std::vector<IceParameter> parameters = fit_parameters(suspect, Eigen::Vector3d::Zero(), model_);
  const FlasherData data = data_of({event_of(with_parameters(model_, parameters, {truth(x), truth(y), 0}),
                                             request(photons_, data_stream + 20))});

  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.judged = false;
  const IceFit fit = fit_ice(model_, data, parameters, options);
  const Eigen::Vector2d found(fit.value(x), fit.value(y));
  const auto error = [&](const Eigen::Vector2d& direction) {
    return std::sqrt(direction.dot(fit.covariance.topLeftCorner(2, 2) * direction));
  };
  EXPECT_NEAR(found.dot(along), truth.dot(along), 3 * error(along));
  EXPECT_LT(error(along), 0.3);
  EXPECT_NEAR(found.dot(across), 0, 2 * error(across));
  EXPECT_GT(error(across), 2);
}

// Two runs that tell of different ice: a fit that leaves one out finds the other's, as a fit to that one
// alone does. What no run that is left tells is where its prior has it.
TEST_F(OfOneFlasher, AFitWithoutARunKnowsNothingOfIt) {
  const double truth[2] = {1.08, 0.92};
  const ModuleId flashers[2] = {{36, 20}, {45, 40}};
  std::vector<Event> events;
  for (std::size_t r = 0; r < 2; ++r) {
    const EffectSetting setting{"absorption-scale", "factor", truth[r]};
    ModelParts parts = parts_of(model_);
    apply_effects({&setting, 1}, parts);
    run_.module = flashers[r];
    events.push_back(event_of(freeze(std::move(parts)), request(photons_, data_stream + 10 + r)));
  }
  const FlasherData data = data_of(events);

  std::vector<IceParameter> parameters{effect_parameter("absorption-scale", model_)};
  parameters.push_back(layer_factor(LayerFamily::scattering, 1720, 1760, model_));  // of the first flasher
  parameters[1].prior = 0.3, parameters[1].prior_centre = 0;
  parameters[1].start = 0.05;
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.judged = false;
  options.light.light = 2;
  const auto without = fit_ice_without(model_, data, parameters, {{0, 1}, {1, 0}}, options);
  for (std::size_t r = 0; r < 2; ++r) {
    ASSERT_TRUE(without[r].numbers.has_value());
    const FlasherData alone = flasher_data(*model_.detector, std::vector{events[r]});
    const IceFit fit = fit_ice(model_, alone, parameters, options);
    // The data are the same; simulations have twice their light each.
    const double noise = fit.error(0) * std::sqrt(2 * 0.5);
    EXPECT_NEAR(parameters[0].logarithmic ? std::exp((*without[r].numbers)[0]) : (*without[r].numbers)[0],
                fit.value(0), 3 * noise);
    EXPECT_NEAR(fit.value(0), truth[r], 3 * fit.error(0));
    EXPECT_LT(fit.error(0), 0.05);
  }
  EXPECT_NEAR((*without[1].numbers)[1], 0, 0.1);
  // What not knowing them costs: about 1 for absorption, which both runs tell alike, and more for the layer,
  // of which the second tells nothing.
  EXPECT_NEAR(without[0].unknown, 1, 0.5);
  EXPECT_GT(without[1].unknown, without[0].unknown + 1);
}

// Rounds that are solved together have the light of all of them: errors of sqrt(1 + 1/(4 L)) instead of
// sqrt(1 + 1/L), with simulations of L times the data's light and four rounds after the first.
TEST_F(OfOneFlasher, AFitThatRemembersHasTheLightOfItsRounds) {
  constexpr double truth = 1.08, light = 0.5;
  const EffectSetting setting{"absorption-scale", "factor", truth};
  ModelParts parts = parts_of(model_);
  apply_effects({&setting, 1}, parts);
  const FlasherData data = data_of({event_of(freeze(std::move(parts)), request(photons_, data_stream + 30))});
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.light = {light, 1, 1e12};
  options.judged = false;
  options.most_rounds = 5;
  options.settled = [](const IceFit&) { return false; };
  const auto fitted = [&](bool remembers) {
    options.remembers = remembers;
    return fit_ice(model_, data, {effect_parameter("absorption-scale", model_)}, options);
  };
  const IceFit fit = fitted(true), forgetful = fitted(false);
  EXPECT_EQ(fit.rounds, 5);
  EXPECT_NEAR(fit.value(0), truth, 3 * fit.error(0));
  const double expected = std::sqrt((1 + 1 / (4 * light)) / (1 + 1 / light));
  EXPECT_NEAR(fit.error(0) / forgetful.error(0), expected, 0.15);
}

TEST_F(OfOneFlasher, AFitKnowsShortStepsOfItsNuisances) {
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  const RunScores scores(data_, options);
  constexpr int parameters = 1;
  const auto is_short = [&](double brightness, double time_zero) {
    return scores.is_short(Eigen::Vector3d(9, brightness, time_zero), parameters);
  };
  EXPECT_TRUE(is_short(-0.05, 1));
  EXPECT_FALSE(is_short(-0.2, 1));
  EXPECT_FALSE(is_short(0.05, -8));
}

// A run whose receivers all saturate has no light to fit.
TEST_F(OfOneFlasher, AFitLeavesOutDarkRuns) {
  FlasherData data = data_of({event_of(model_, request(photons_, data_stream + 1)),
                              event_of(model_, request(photons_, data_stream + 40))});
  const auto darken = [&](RunData& run) {
    std::ranges::fill(run.used, char{0});
    run.pulses.clear();
    run.charge = 0;
  };
  darken(data.runs[0]);
  IceFitOptions options;
  static_cast<RunSettings&>(options) = settings_;
  options.most_rounds = 1;
  const std::vector<IceParameter> parameters{effect_parameter("absorption-scale", model_)};
  const IceFit fit = fit_ice(model_, data, parameters, options);
  EXPECT_EQ(fit.runs.size(), 1u);
  ASSERT_EQ(fit.left_out.size(), 1u);
  EXPECT_NE(fit.left_out[0].find("no receiver is left"), std::string::npos) << fit.left_out[0];
  darken(data.runs[1]);
  EXPECT_THROW(fit_ice(model_, data, parameters, options), NoResult);
}

class ASurvey : public OfOneFlasher {
 protected:
  static constexpr double more_ = 8;  // times the data's light, for the light of a change
  ASurvey() {
    for (const char* name : {"absorption-scale", "scattering-scale", "angular-acceptance", "flow-azimuth"})
      parameters_.push_back(effect_parameter(name, model_));
    // The same for all tests.
    static const Survey survey =
        survey_data(model_, data_, look_, {.parameters = parameters_, .pair_light = 1}, settings_);
    survey_ = survey;
  }
  // The gap that light of this model leaves, without most of its noise: random numbers are the base's.
  Eigen::VectorXd gap_of_light(const Model& model) const {
    SurveyCounts counts = measured_counts(survey_);
    counts[0].data.setZero();
    for (const SimulatedHit& hit : simulate_run(model, request(more_ * photons_, data_stream + 2)).hits)
      if (const int bin = survey_.runs[0].bins.bin(hit.module, hit.time); bin >= 0)
        counts[0].data(bin) += 1 / more_;
    return gap_of(survey_, counts);
  }
  Eigen::Index column(SurveyColumn::Kind kind, int string, int dom) const {
    for (std::size_t c = 0; c < survey_.columns.size(); ++c) {
      const SurveyColumn& column = survey_.columns[c];
      if (column.kind == kind && column.string == string && column.dom == dom)
        return static_cast<Eigen::Index>(c);
    }
    ADD_FAILURE() << "no such column";
    return 0;
  }
  int brightest_other_string() const {
    int best = 0;
    double most = 0;
    for (std::size_t c = 0; c < survey_.columns.size(); ++c) {
      const SurveyColumn& column = survey_.columns[c];
      const auto i = static_cast<Eigen::Index>(c);
      if (column.kind != SurveyColumn::Kind::string_efficiency || column.string == run_.module.string)
        continue;
      if (survey_.information(i, i) > most) most = survey_.information(i, i), best = column.string;
    }
    return best;
  }
  double gap_of_change(const std::vector<std::string>& settings, Eigen::Index column) const {
    ModelRequest changed;
    for (const std::string& text : settings) changed.with.push_back(parse_effect_setting(text));
    return gap_of_light(load_model(changed))(column);
  }
  // The gap is information times the change; how large the change is, in standard deviations, does not matter
  // as long as it stays small.
  void expect_found(const std::vector<std::string>& settings, Eigen::Index column, double change) const {
    static const Eigen::VectorXd unchanged = gap_of_light(model_);
    expect_gap(gap_of_change(settings, column) - unchanged(column), column, change, settings.back());
  }
  // Light of near modules grows more towards the flasher than it fades away from it: half of the difference.
  void expect_displaced(int string, SurveyColumn::Kind kind, double change) const {
    const char axis = "xyz"[static_cast<int>(kind) - static_cast<int>(SurveyColumn::Kind::string_x)];
    const Eigen::Index at = column(kind, string, 0);
    const auto gap = [&](double way) {
      return gap_of_change({fmt::format("geometry-offset.string={}", string),
                            fmt::format("geometry-offset.{}={}", axis, way * change)},
                           at);
    };
    expect_gap((gap(1) - gap(-1)) / 2, at, change, fmt::format("string {} {}", string, axis));
  }
  void expect_gap(double found, Eigen::Index column, double change, const std::string& of) const {
    const double expected = survey_.information(column, column) * change,
                 noise = std::sqrt(2 / more_ * survey_.noise(column, column));
    EXPECT_GT(std::abs(expected), 6 * noise) << of << ": too small a change to be seen";
    EXPECT_NEAR(found, expected, 0.1 * std::abs(expected) + 2 * noise) << of;
  }
  std::vector<IceParameter> parameters_;
  Survey survey_;
};

TEST_F(ASurvey, KnowsHowChangesShow) {
  using Kind = SurveyColumn::Kind;
  const int string = 36;  // the flasher's own, the brightest
  const int other = brightest_other_string();
  const std::string on_other = fmt::format("string={}", other);
  expect_found({"absorption-scale.factor=1.1"}, 0, 0.1);
  expect_found({"scattering-scale.factor=1.05"}, 1, 0.05);
  expect_found({"angular-acceptance.slope=0.2"}, 2, 0.2);
  expect_found({"flow-azimuth.azimuth=142"}, 3, 12);
  expect_found({"string-efficiency.string=36", "string-efficiency.factor=1.2"},
               column(Kind::string_efficiency, string, 0), 0.2);
  expect_found({"module-efficiency.string=36", "module-efficiency.dom=21", "module-efficiency.factor=1.5"},
               column(Kind::module_efficiency, string, 21), 0.5);
  expect_found({"time-offset." + on_other, "time-offset.time=5"}, column(Kind::string_time, other, 0), 5);
  expect_displaced(other, Kind::string_x, 3);
  expect_displaced(other, Kind::string_z, 3);
  expect_displaced(string, Kind::string_x, 2);
}

// Of the true model the gap is noise: of data and simulation, as much as the survey says.
TEST_F(ASurvey, GapsOfTheTruthAreItsNoise) {
  constexpr int draws = 400;
  const auto size = static_cast<Eigen::Index>(parameters_.size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size), squares = mean;
  for (int d = 0; d < draws; ++d) {
    const Eigen::VectorXd gap =
        gap_of(survey_, drawn_counts(survey_, 1, static_cast<std::uint64_t>(d))).head(size);
    mean += gap / draws, squares += gap.cwiseAbs2() / draws;
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const double variance = survey_.noise(i, i);
    EXPECT_NEAR(mean(i), 0, 4 * std::sqrt(variance / draws)) << i;
    EXPECT_NEAR((squares(i) - mean(i) * mean(i)) / variance, 1, 4 * std::sqrt(2.0 / draws) + 0.1) << i;
  }
}

// A module that counts more light is imitated in part by its whole string, brightness and time zero. What is
// left of it, by least squares, is what tells the two apart.
TEST_F(ASurvey, KnowsHowMuchLightTellsEffectsApart) {
  using Kind = SurveyColumn::Kind;
  constexpr double change = 0.2;
  const auto suspect = [&](const char* effect, Kind kind, int string, int dom) {
    const auto at = static_cast<int>(column(kind, string, dom));
    return Suspect{effect, {{"string", string}, {"dom", dom}}, {{{at, 1.0}}}};
  };
  const std::vector<Suspect> suspects{suspect("module-efficiency", Kind::module_efficiency, 36, 21),
                                      suspect("string-efficiency", Kind::string_efficiency, 36, 0)};
  const ScoreTester tester(survey_, suspects, parameters_, Draws{50, 1});
  Score score{suspects[0], 0, Eigen::VectorXd::Constant(1, change)};
  const auto apart = [&] {
    return separation(survey_, axes_of(model_, survey_), tester.difference(score, "string-efficiency"), "one",
                      "other");
  };

  const SurveyRun& run = survey_.runs[0];
  Eigen::VectorXd of_module = Eigen::VectorXd::Zero(run.bins.size());
  Eigen::MatrixXd imitations(run.bins.size(), 3);
  imitations << of_module, run.nuisance;
  for (const RunBins::Receiver& receiver : run.bins.receivers()) {
    const ModuleId id = model_.detector->modules()[receiver.module].id;
    if (id == ModuleId{36, 21}) of_module.segment(receiver.first, receiver.bins()).setConstant(change);
    if (id.string == 36) imitations.col(0).segment(receiver.first, receiver.bins()).setOnes();
  }
  const Eigen::VectorXd root = (run.trust * run.expected).sqrt();
  const Eigen::VectorXd best =
      (root.asDiagonal() * imitations).colPivHouseholderQr().solve(root.asDiagonal() * of_module);
  const double square =
      (run.expected * (of_module - imitations * best).array().square()).sum() / run.data_dispersion;
  const Separation found = apart();
  EXPECT_NEAR(found.light * square / 9, 1, 0.05);
  EXPECT_EQ(found.run, "36,20");
  EXPECT_NE(found.sentence.find("on modules below their flashers"), std::string::npos) << found.sentence;

  score.amplitudes *= 1e-6;
  EXPECT_EQ(apart().light, std::numeric_limits<double>::infinity());
  EXPECT_NE(apart().sentence.find("other places"), std::string::npos);
}

// Of two strings that count too much light either may be the one; a place that explains nothing is no rival.
TEST_F(ASurvey, AsksAtOtherPlacesThatExplainNearlyAsMuch) {
  const int other = brightest_other_string();
  std::vector<Suspect> suspects;
  for (const int string : {36, other}) {
    const auto at = static_cast<int>(column(SurveyColumn::Kind::string_efficiency, string, 0));
    suspects.push_back({"string-efficiency", {{"string", string}}, {{{at, 1.0}}}});
  }
  const ScoreTester tester(survey_, suspects, parameters_, Draws{50, 1});
  // Counts as expected, but for these changes.
  const auto first = [&](double on_other) {
    SurveyCounts counts = measured_counts(survey_);
    counts[0].data = survey_.runs[0].expected;
    for (const RunBins::Receiver& receiver : survey_.runs[0].bins.receivers()) {
      const int string = model_.detector->modules()[receiver.module].id.string;
      auto own = counts[0].data.segment(receiver.first, receiver.bins());
      if (string == 36) own *= 1.3;
      if (string == other) own *= 1 + on_other;
    }
    return tester.test(counts, 0.001).effects.front();
  };
  const auto information = [&](std::size_t i) {
    const int at = suspects[i].amplitudes[0][0].first;
    return survey_.information(at, at);
  };
  const double as_visible = 0.3 * std::sqrt(information(0) / information(1));
  const EffectScore alone = first(0), both = first(0.9 * as_visible);
  EXPECT_EQ(alone.best.suspect.place, suspects[0].place);
  EXPECT_FALSE(alone.elsewhere);
  ASSERT_TRUE(both.elsewhere);
  EXPECT_FALSE(is_same_place(both.elsewhere->suspect.place, both.best.suspect.place));
  EXPECT_GT(both.elsewhere->gain, 0.5 * both.best.gain);
  EXPECT_LE(both.elsewhere->gain, both.best.gain);
}

// Of two amplitudes that do the same, light tells the sum; each may be a large change off.
TEST_F(ASurvey, DoesNotClaimWhatLightDoesNotShow) {
  const auto at = static_cast<int>(column(SurveyColumn::Kind::string_efficiency, 36, 0));
  const std::vector<Suspect> suspects{{"string-efficiency", {{"string", 36}}, {{{at, 1.0}}, {{at, 1.0}}}}};
  const ScoreTester tester(survey_, suspects, parameters_, Draws{50, 1});
  const double of_sum = std::sqrt(survey_.noise(at, at)) / survey_.information(at, at),
               unknown = large_change(SurveyColumn::Kind::string_efficiency) / std::sqrt(2);
  ASSERT_EQ(tester.suspects().size(), 1U);
  EXPECT_EQ(tester.suspects()[0].degrees, 1);
  for (const double error : tester.suspects()[0].errors())
    EXPECT_NEAR(error, std::hypot(of_sum / 2, unknown), 1e-6 * unknown);
}

// What blind trials hide has the expected gain of the significance that was drawn, within the wanted range,
// at any of its places, and is a change of the model.
TEST_F(ASurvey, HidesEffectsAsStrongAsWanted) {
  const std::vector<int> strings{36, brightest_other_string()};
  std::vector<Suspect> suspects;
  for (const int string : strings) {
    const auto at = static_cast<int>(column(SurveyColumn::Kind::string_efficiency, string, 0));
    suspects.push_back({"string-efficiency", {{"string", string}}, {{{at, 1.0}}}});
  }
  const ScoreTester tester(survey_, suspects, parameters_, Draws{50, 1});
  const SignificanceRange wanted{5, 8};
  std::vector<const TestedSuspect*> places;
  for (const TestedSuspect& suspect : tester.suspects()) places.push_back(&suspect);
  std::mt19937_64 random(1);
  constexpr int draws = 60;
  int ups = 0;
  std::map<double, int> times;
  for (int i = 0; i < draws; ++i) {
    const std::optional<Hidden> hidden = draw_hidden(places, tester, model_, wanted, random);
    ASSERT_TRUE(hidden.has_value());
    const double significance = hidden->effect.significance, string = hidden->effect.place.at("string");
    EXPECT_GE(significance, wanted.least);
    EXPECT_LE(significance, wanted.most);
    const TestedSuspect& place = *places[string == strings[0] ? 0 : 1];
    ASSERT_EQ(hidden->numbers.size(), 1u);
    const double change = hidden->numbers[0] - 1, gain = tester.gain_of_significance(place, significance);
    EXPECT_NEAR(place.expected_gain(Eigen::VectorXd::Constant(1, change)), gain, 0.1 * gain);
    EXPECT_NE(difference(model_, hidden->model), ModelDifference{});
    ++times[string], ups += change > 0;
  }
  EXPECT_EQ(times.size(), 2u);
  // Up or down, by a fair coin where both are within limits.
  EXPECT_NEAR(ups, draws / 2.0, 4 * std::sqrt(draws / 4.0));

  // A gain that no efficiency within its limits has.
  EXPECT_FALSE(draw_hidden(places, tester, model_, {500, 500}, random).has_value());
}

// Of light with the change that is said to be seen half of the time, half is named.
TEST_F(ASurvey, NamesEveryOtherTimeWhatIsJustSeen) {
  constexpr double alpha = 0.01;
  const std::vector<Suspect> suspects{{"absorption-scale", {}, {{{0, 1.0}}}}};
  const ScoreTester tester(survey_, suspects, parameters_, Draws{400, 1});
  const std::vector<SeenAbove> seen = seen_above(tester, model_, alpha, 0);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].parameter, "absorption-scale.factor");
  const SurveyRun& run = survey_.runs[0];
  const Eigen::ArrayXd slope = (run.halves[0].col(0) + run.halves[1].col(0)).array() / 2;
  constexpr int draws = 400;
  int named = 0;
  for (std::uint64_t d = 0; d < draws; ++d) {
    SurveyCounts counts = drawn_counts(survey_, 3, d);
    counts[0].data.array() *= 1 + seen[0].change * slope;
    named += tester.test(counts, 0).p_value < alpha;
  }
  // Half, but for what 400 draws know of a probability of 1% (a tenth of the gain).
  EXPECT_NEAR(named / double(draws), 0.5, 0.1 + 4 * std::sqrt(0.25 / draws));
  // The floor is a change of the light: where it is larger, it is the limit.
  const double size = tester.suspects()[0].size(Eigen::VectorXd::Ones(1));
  EXPECT_DOUBLE_EQ(seen_above(tester, model_, alpha, 1)[0].change, 1 / size);
}

// Simulations of one model differ in how well they fit the same data, by as much as is said.
TEST_F(ASurvey, SimulationsDifferByTheirNoise) {
  constexpr int pairs = 100;
  double squares = 0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const SurveyCounts one = drawn_counts(survey_, 2, 2 * i);
    SurveyCounts other = drawn_counts(survey_, 2, 2 * i + 1);
    other[0].data = one[0].data;
    squares += std::pow(neg_llh_of(survey_, one)[0] - neg_llh_of(survey_, other)[0], 2) / pairs;
  }
  const double light = (survey_.runs[0].counts.simulated[0] + survey_.runs[0].counts.simulated[1]).sum() /
                       survey_.runs[0].counts.data.sum();
  EXPECT_NEAR(squares / variance_of_difference(survey_.bins, light), 1, 4 * std::sqrt(2.0 / pairs));
}

}  // namespace
}  // namespace floe::test

// Effects that a diagnosis has added, as they come, fade and go.
#include "reco/diagnose/accepted_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reco/diagnose/score_test.h"
#include "reco/ice_fit/ice_solution.h"

namespace floe::test {
namespace {

class Accepted : public ::testing::Test {
 protected:
  const Model base_ = load_model({});  // absorption anisotropy 0.6, flow azimuth 130 deg
  AcceptedEffects accepted_{base_};

  // A fit of all that is there and of one more, which ends at `numbers`.
  void add(const std::string& effect, const std::string& parameter, const std::vector<double>& numbers,
           const std::vector<double>& errors) {
    NamedEffect named;
    named.suspect.effect = effect;
    named.parameters = {effect_parameter(effect + "." + parameter, base_)};
    accepted_.add(named, fit(accepted_.parameters(named.parameters), numbers, errors));
  }
  static IceFit fit(std::vector<IceParameter> parameters, std::vector<double> numbers,
                    const std::vector<double>& errors) {
    IceFit fit;
    fit.parameters = std::move(parameters);
    fit.numbers = std::move(numbers);
    const Eigen::Map<const Eigen::VectorXd> error(errors.data(), static_cast<Eigen::Index>(errors.size()));
    fit.covariance = error.cwiseAbs2().asDiagonal();
    return fit;
  }
};

TEST_F(Accepted, BeginWhereTheyAreWithPriorsWhereTheyWere) {
  add("absorption-anisotropy", "k1", {0.4}, {0.05});
  const IceParameter more = effect_parameter("noise.rate", base_);
  const std::vector<IceParameter> all = accepted_.parameters({more});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].start, 0.4);
  EXPECT_EQ(all[0].prior_centre, 0.6);
  EXPECT_EQ(all[1].start, more.start);
  EXPECT_EQ(accepted_.model().ice->tables().configuration.absorption_anisotropy->k1, 0.4);
}

TEST_F(Accepted, AreAsSignificantAsTheyAreFarFromTheBase) {
  add("absorption-anisotropy", "k1", {0.4}, {0.05});
  EXPECT_NEAR(accepted_.effects()[0].significance, (0.6 - 0.4) / 0.05, 1e-6);
}

TEST_F(Accepted, TakeOnlyTheirOwnParametersWithThem) {
  add("absorption-anisotropy", "k1", {0.4}, {0.05});
  add("flow-azimuth", "azimuth", {0.45, 120}, {0.05, 1});
  add("noise", "rate", {0.5, 121, 700}, {0.05, 1, 10});
  accepted_.drop(1);
  ASSERT_EQ(accepted_.effects().size(), 2u);
  EXPECT_EQ(accepted_.effects()[1].suspect.effect, "noise");
  const std::vector<IceParameter> left = accepted_.parameters();
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].start, 0.5);
  EXPECT_EQ(left[1].start, 700);
}

// What came last cannot have been explained away yet.
TEST_F(Accepted, FadeWhenALaterOneExplainsThem) {
  add("absorption-anisotropy", "k1", {0.4}, {0.05});
  add("flow-azimuth", "azimuth", {0.5, 131}, {0.05, 1});  // 2 and 1 standard deviations
  const auto faded = accepted_.faded();
  ASSERT_TRUE(faded.has_value());
  EXPECT_EQ(faded->effect, 0u);
  EXPECT_NEAR(faded->sigmas, 2, 1e-6);
  accepted_.drop(0);
  EXPECT_FALSE(accepted_.faded());
}

// Strings may be wrong one by one; of bands and of all else a model holds one.
TEST_F(Accepted, HoldSeveralStringsButOneBand) {
  const auto suspect = [](const char* effect, Place place) {
    Suspect asked{effect, std::move(place), {}};
    asked.amplitudes = {{{0, 1}}};
    return asked;
  };
  NamedEffect late;
  late.suspect = suspect("time-offset", {{"string", 36}});
  late.parameters = fit_parameters(late.suspect, Eigen::VectorXd::Constant(1, 5), base_);
  accepted_.add(late, fit(accepted_.parameters(late.parameters), {5}, {1}));
  EXPECT_TRUE(accepted_.has(suspect("time-offset", {{"string", 36}})));
  EXPECT_FALSE(accepted_.has(suspect("time-offset", {{"string", 37}})));
  EXPECT_FALSE(accepted_.has(suspect("string-efficiency", {{"string", 36}})));
  NamedEffect band;
  band.suspect = suspect("absorption-layer", {{"depth", 1775}, {"width", 60}});
  for (const char* name : {"depth", "width", "factor"})
    band.parameters.push_back(effect_parameter(std::string("absorption-layer.") + name, base_));
  accepted_.add(band, fit(accepted_.parameters(band.parameters), {5, 1780, 70, 1.5}, {1, 2, 5, 0.1}));
  EXPECT_TRUE(accepted_.has(suspect("absorption-layer", {{"depth", 2200}, {"width", 60}})));
  // Its place is where the fit has it.
  EXPECT_EQ(accepted_.effects()[1].suspect.place.at("depth"), 1780);
  EXPECT_EQ(accepted_.effects()[1].suspect.place.at("width"), 70);
}

// What came in after birefringence may be what shows how its layers differ.
TEST_F(Accepted, AreRefinedByLayersWhateverCameLater) {
  add("birefringence", "strength", {0.8}, {0.05});
  add("noise", "rate", {0.8, 700}, {0.05, 10});
  const auto layers = accepted_.parameters_by_layers(0, LayerFamily::birefringence, {1700, 2000, 3});
  ASSERT_EQ(layers.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(layers[i].start, std::log(0.8)) << i;
  EXPECT_EQ(layers[3].name, "noise.rate");
  // 3, 1 and 2 standard deviations from their mean, which is -0.1.
  const IceFit fitted = fit(layers, {-0.4, 0, 0.1, 600}, {0.1, 0.1, 0.1, 10});
  EXPECT_NEAR(accepted_.spread_of_layers(0, fitted), 9 + 1 + 4, 1e-9);
  accepted_.take_layers(0, fitted);
  ASSERT_EQ(accepted_.effects()[0].values.size(), 3u);
  EXPECT_NEAR(accepted_.effects()[0].mean->value, (std::exp(-0.4) + 1 + std::exp(0.1)) / 3, 1e-9);
  EXPECT_EQ(accepted_.effects()[1].values, (std::vector<double>{600}));
  accepted_.drop(0);
  EXPECT_EQ(accepted_.parameter_count(), 1u);
}

// The strength that layers start from was fitted while something else was missing: six of them, each known to
// 40% and all by 50% above it, are not held there by their priors.
TEST_F(Accepted, LayersAreNotHeldAtTheStrengthTheyStartFrom) {
  const double start = std::log(1.1), truth = std::log(1.65), error = 0.4;
  add("birefringence", "strength", {std::exp(start)}, {0.1});
  const auto layers = accepted_.parameters_by_layers(0, LayerFamily::birefringence, {1700, 2300, 6});
  ScoreSystem light(6);
  light.information = light.noise = light.slope = Eigen::MatrixXd::Identity(6, 6) / (error * error);
  light.gap = Eigen::VectorXd::Constant(6, (truth - start) / (error * error));
  const IceSolution solution = solve_ice(light, layers, std::vector<double>(6, start), {}, 10);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_NEAR(start + solution.step(i), truth, 0.05 * truth) << i;
}

// Layers that differ both ways about the base's strength are no base of that strength.
TEST_F(Accepted, AreAsSignificantAsTheirLayersTogether) {
  add("birefringence", "strength", {1}, {0.05});
  const auto layers = accepted_.parameters_by_layers(0, LayerFamily::birefringence, {1700, 2000, 3});
  accepted_.take_layers(0, fit(layers, {-0.4, 0.4, 0}, {0.1, 0.1, 0.1}));
  const double ln_p = std::log(std::erfc(4) + 8 / std::sqrt(M_PI) * std::exp(-16));  // chi-square 32 of 3
  EXPECT_NEAR(accepted_.effects()[0].significance, sigmas_of(ln_p), 1e-6);
}

TEST_F(Accepted, GoToFloesOwnFileOnlyWhereNoOtherHoldsThem) {
  add("absorption-anisotropy", "k1", {0.4}, {0.05});
  EXPECT_TRUE(accepted_.beside_ice().empty());
  add("noise", "rate", {0.4, 700}, {0.05, 10});
  const EffectGroups beside = accepted_.beside_ice();
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_EQ(beside[0], (std::vector<EffectSetting>{{"noise", "rate", 700}}));
}

}  // namespace
}  // namespace floe::test

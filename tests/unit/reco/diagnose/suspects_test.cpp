// Suspects and the probabilities that they are judged by.
#include "reco/diagnose/suspects.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "reco/diagnose/goodness.h"
#include "reco/diagnose/rivals.h"
#include "reco/diagnose/score_test.h"

namespace floe::test {
namespace {

TEST(Probabilities, AreStandardDeviationsOfAGaussian) {
  EXPECT_EQ(sigmas_of(0), 0);
  EXPECT_NEAR(sigmas_of(std::log(0.31731)), 1, 1e-4);
  EXPECT_NEAR(sigmas_of(std::log(0.0026998)), 3, 1e-4);
  EXPECT_NEAR(sigmas_of(std::log(5.7330e-7)), 5, 1e-4);
  // Where erfc has no number any more: p = 2 phi(s)/s (1 - 1/s^2 ...).
  const double s = 50;
  EXPECT_NEAR(sigmas_of(-s * s / 2 + std::log(2 / std::sqrt(2 * M_PI) / s)), s, 0.01);
  for (const double sigmas : {0.5, 3.0, 12.0, 80.0}) EXPECT_NEAR(sigmas_of(ln_p_of(sigmas)), sigmas, 1e-9);
}

EffectScore score(double likeness, double ln_p, double gain = 30) {
  EffectScore effect;
  effect.likeness = likeness, effect.ln_p = ln_p, effect.best.gain = gain;
  return effect;
}

// Alike, or half alike and as probable.
TEST(Rivals, AreInseparableWhereBothMayBeWhatIsMissing) {
  const EffectScore first = score(1, -20);
  EXPECT_TRUE(is_inseparable(score(0.95, -5), first));
  EXPECT_FALSE(is_inseparable(score(1, -5, 12), first));  // the data have told them apart
  EXPECT_TRUE(is_inseparable(score(0.7, -18), first));
  EXPECT_FALSE(is_inseparable(score(0.7, -12), first));
  EXPECT_FALSE(is_inseparable(score(0.2, -20), first));  // another effect, as strong
}

// A third of the gain that no chance explains is worth a fit.
TEST(Rivals, AreFittedWhereTheyMayBeWhatIsMissing) {
  const EffectScore first = score(1, -20);
  EXPECT_TRUE(leads(first, first));
  EXPECT_TRUE(leads(score(0.2, -8, 12), first));
  EXPECT_FALSE(leads(score(0.2, -8, 9), first));
  EXPECT_FALSE(leads(score(0.2, -4, 12), first));           // some place gains as much by chance
  EXPECT_FALSE(leads(score(1, -8, 4), score(1, -8, 4.5)));  // too little to be fitted
}

// If the rival were true, a leader of likeness 0.8 would gain 64% and leave 36%: 169 of 300 gained.
TEST(Rivals, AreAlternativesWhereTheLeaderMayHaveLeftWhatTheyWould) {
  const EffectScore first = score(1, -20);
  EXPECT_FALSE(is_alternative(score(0.8, -8, 20), first, 300, 160));
  EXPECT_TRUE(is_alternative(score(0.8, -8, 20), first, 300, 170));
  EXPECT_FALSE(is_alternative(score(0.8, -8, 16), first, 300, 170));  // far behind
  EXPECT_FALSE(is_alternative(score(0, -8, 20), first, 300, 1e6));    // would leave all of it
  EXPECT_TRUE(is_alternative(score(1, -8, 20), first, 300, 0));       // the same
  EXPECT_TRUE(is_alternative(score(0, -16, 25), first, 300, 0));      // scores nearly as well
  EXPECT_TRUE(is_alternative(score(0.92, -8, 16), first, 1e4, 1));    // inseparable until fits decide
}

// The leader, of a gain of 28, explains the square of the likeness of it.
TEST(Rivals, WaitWhereTheLeaderLeavesThemEnoughToLead) {
  const EffectScore first = score(1, -20, 28);
  EXPECT_FALSE(waits(first, first));
  EXPECT_TRUE(waits(score(0.5, -8, 17), first));  // 7 are explained, and 10 lead
  EXPECT_FALSE(waits(score(0.5, -8, 16), first));
  EXPECT_FALSE(waits(score(0.5, -4, 17), first));  // by chance
}

// Also of one that is better than any that differs by the floor only.
TEST(Probabilities, OfAnExpectedFitAreLarge) {
  const ExpectedFit right{100, 10};
  EXPECT_NEAR(probability_of(100, right), 0.5, 0.03);
  EXPECT_LT(probability_of(150, right), 1e-4);
  EXPECT_EQ(probability_of(-20, right), 1);
}

// Of exponential gains every probability is known.
TEST(Probabilities, BeyondTheDrawsFallExponentially) {
  std::vector<double> drawn;
  for (int i = 0; i < 1000; ++i) drawn.push_back(-std::log((i + 0.5) / 1000));
  EXPECT_NEAR(ln_tail_probability(20, drawn), -20, 0.1);
  EXPECT_NEAR(ln_tail_probability(5, drawn), -5, 0.1);
  EXPECT_EQ(ln_tail_probability(0, drawn), 0);
}

class Suspects : public ::testing::Test {
 protected:
  const Model model_ = load_model({});
  const SuspectPlan plan_ = plan_suspects(model_, {1700, 1900}, 3, 1);

  bool planned(const std::string& name) const {
    return std::any_of(plan_.parameters.begin(), plan_.parameters.end(),
                       [&](const IceParameter& p) { return p.name == name; });
  }
};

TEST_F(Suspects, AreTheEffectsThatTheDataCanTell) {
  for (const char* name :
       {"birefringence.strength", "absorption-anisotropy.k1", "flow-azimuth.azimuth", "tilt 1800 m",
        "scattering-function.g", "hole-ice.radius", "flasher-profile.width", "noise.rate"})
    EXPECT_TRUE(planned(name)) << name;
  // Taken up by each run's brightness and time zero, judged place by place, or another name for the strength
  // of birefringence.
  for (const char* name :
       {"flasher-brightness.factor", "overall-efficiency.factor", "time-offset.time",
        "absorption-layer.factor", "string-efficiency.factor", "grains.size", "grains.elongation"})
    EXPECT_FALSE(planned(name)) << name;
  // Where there is no hole ice, its scattering length changes nothing.
  EXPECT_FALSE(planned("hole-ice.scattering"));
}

// As rivals are, which may be two places of one effect.
TEST_F(Suspects, OfOneKindHaveTheirOwnBands) {
  std::vector<IceParameter> parameters;
  std::vector<double> numbers;
  for (const double depth : {1750.0, 1850.0})
    for (const auto& [name, number] : {std::pair{"depth", depth}, {"width", 40.0}, {"factor", 2.0}}) {
      parameters.push_back(effect_parameter(std::string("absorption-layer.") + name, model_));
      numbers.push_back(number);
    }
  const Model changed = with_parameters(model_, parameters, numbers);
  const IceTables &before = model_.ice->tables(), &after = changed.ice->tables();
  for (std::size_t i = 0; i < before.layers.size(); ++i) {
    const double depth = before.layers[i].depth;
    const bool inside = std::abs(depth - 1750) < 15 || std::abs(depth - 1850) < 15;
    const bool outside = std::abs(depth - 1750) > 25 && std::abs(depth - 1850) > 25;
    const double factor = after.layers[i].dust_absorption / before.layers[i].dust_absorption;
    if (inside || outside) {
      EXPECT_NEAR(factor, inside ? 2 : 1, 1e-9) << depth;
    }
  }
}

TEST_F(Suspects, SayWhyOthersAreNone) {
  const auto why = [&](const char* effect) { return why_no_suspect(effect, model_, 16); };
  EXPECT_NE(why("hole-ice").find("--oversize 1"), std::string::npos);
  EXPECT_NE(why("grains").find("birefringence by another name"), std::string::npos);
  EXPECT_NE(why("flasher-brightness").find("brightness of each run"), std::string::npos);
  EXPECT_NE(why("cable-shadow").find("where the cables are is not known"), std::string::npos);
  EXPECT_NE(why("module-efficiency").find("no module sees 150 counts"), std::string::npos);
  EXPECT_NE(why("time-offset").find("no string sees 300 counts"), std::string::npos);
  EXPECT_NE(why("scattering-layer").find("within 150 m of the flashers"), std::string::npos);
}

TEST_F(Suspects, HoleIceIsNoneWhereModulesAreWidened) {
  for (const IceParameter& p : plan_suspects(model_, {1700, 1900}, 3, 16).parameters)
    EXPECT_FALSE(p.name.starts_with("hole-ice")) << p.name;
}

// Rows beyond follow the outermost layers of a fit.
TEST_F(Suspects, BandsReachNoFurtherThanTheirOwnLayers) {
  Survey survey;
  for (std::size_t p = 0; p < plan_.parameters.size(); ++p)
    survey.columns.push_back({SurveyColumn::Kind::parameter, p, 0, 0});
  const int outermost[] = {plan_.first_layer, plan_.first_layer + plan_.bands.groups - 1};
  int bands = 0;
  for (const Suspect& suspect : suspects_of(survey, plan_)) {
    if (suspect.effect != "absorption-layer") continue;
    ++bands;
    for (const auto& [column, weight] : suspect.amplitudes[0])
      for (const int at : outermost) EXPECT_NE(column, at);
  }
  EXPECT_GT(bands, 20);
}

// Crystals as strong as a first guess scatter more than clear layers do: the fit begins part of the way
// there.
TEST_F(Suspects, BeginWhereIceCanBe) {
  ModelRequest request;
  request.without = {"birefringence"};
  const Model base = load_model(request);
  const Suspect crystals{"birefringence", {}, {{{0, 1.0}}}};
  const auto begin = fit_parameters(crystals, Eigen::VectorXd::Constant(1, 1e3), base);
  ASSERT_EQ(begin.size(), 1u);
  EXPECT_GT(begin[0].start, 0);
  with_parameters(base, begin, {begin[0].start});
}

// The most likely amplitudes within the limits, and what they gain.
TEST(TestedSuspects, KeepToTheirLimits) {
  const Suspect suspect{"geometry-offset", {{"string", 36}}, {{{0, 1.0}}, {{1, 1.0}}}};
  TestedSuspect tested{.suspect = &suspect,
                       .information = (Eigen::Matrix2d() << 2, 1, 1, 2).finished(),
                       .noise = (Eigen::Matrix2d() << 3, 1, 1, 2.5).finished(),
                       .inverse_information = {},
                       .inverse_noise = {},
                       .unknown = Eigen::VectorXd::Zero(2),
                       .low = Eigen::Vector2d(-1, -1),
                       .high = Eigen::Vector2d(1, 1),
                       .light = 1,
                       .degrees = 2};
  tested.inverse_information = tested.information.inverse();
  tested.inverse_noise = tested.noise.inverse();
  const auto gain_at = [&](const Eigen::Vector2d& gap, const Eigen::Vector2d& at) {
    const Eigen::Vector2d expected = tested.information * at;
    return expected.dot(tested.inverse_noise * (gap - expected / 2));
  };
  const Eigen::Vector2d inside(0.8, -0.3);
  EXPECT_LT((tested.amplitudes(inside) - tested.inverse_information * inside).norm(), 1e-12);
  EXPECT_NEAR(tested.gain(inside, 0), inside.dot(tested.inverse_noise * inside) / 2, 1e-12);
  const Eigen::Vector2d outside(4, -1);
  double most = 0;
  for (int x = -100; x <= 100; ++x)
    for (int y = -100; y <= 100; ++y) most = std::max(most, gain_at(outside, {x / 100.0, y / 100.0}));
  EXPECT_NEAR(tested.gain(outside, 0), most, 1e-3 * most);
  EXPECT_LE(tested.amplitudes(outside).cwiseAbs().maxCoeff(), 1);
  EXPECT_EQ(tested.gain(inside, 10), 0);  // changes light by less than the floor
}

// Twice the gain of k amplitudes is chi-square of k degrees.
TEST(TestedSuspects, AreSurprisingByTheNumberOfTheirAmplitudes) {
  TestedSuspect tested{};
  tested.degrees = 2;
  EXPECT_NEAR(tested.surprise(12), 12, 1e-9);
  tested.degrees = 6;  // exp(-x) (1 + x + x^2/2)
  EXPECT_NEAR(tested.surprise(12), 12 - std::log(1 + 12 + 72), 1e-9);
  EXPECT_NEAR(tested.surprise(2000), 2000 - std::log(1 + 2000 + 2e6), 1e-3);
  tested.degrees = 1;
  EXPECT_NEAR(tested.surprise(8), -ln_p_of(4), 1e-6);
}

TEST_F(Suspects, BandsLieWithinTheDepthsThatFlashersReach) {
  const BandGrid& bands = plan_.bands;
  EXPECT_GE(bands.top, 1500);
  EXPECT_LE(bands.top + bands.groups * bands.step, 2100);
  EXPECT_EQ(plan_.parameters.size(), static_cast<std::size_t>(plan_.first_layer + 2 * bands.groups));
  EXPECT_EQ(plan_.parameters[static_cast<std::size_t>(plan_.first_layer)].family, "absorption");
}

// What one run alone tells could not be held out.
TEST_F(Suspects, TiltHasASlopeForTwoRuns) {
  EXPECT_EQ(plan_.first_layer - plan_.first_tilt, 1);
  EXPECT_EQ(plan_.parameters[static_cast<std::size_t>(plan_.first_tilt)].family, "tilt");
  const FlasherDepths depths{1700, 2000};
  EXPECT_EQ(slopes_of(depths, 1).groups, 1);
  EXPECT_EQ(slopes_of(depths, 6).groups, 3);
  EXPECT_EQ(slopes_of(depths, 100).groups, 10);
}

TEST_F(Suspects, BecomeParametersOfAFit) {
  const Suspect string{"string-efficiency", {{"string", 36}}, {{{0, 1.0}}}};
  const auto factor = fit_parameters(string, Eigen::VectorXd::Constant(1, -0.2), model_);
  ASSERT_EQ(factor.size(), 1u);
  EXPECT_NEAR(factor[0].start, 0.8, 1e-12);
  EXPECT_EQ(factor[0].prior, 0);
  const Model dimmer = with_parameters(model_, factor, {0.8});
  for (std::size_t i = 0; i < model_.detector->size(); ++i) {
    const Module &was = model_.detector->modules()[i], &is = dimmer.detector->modules()[i];
    EXPECT_NEAR(is.relative_efficiency, was.relative_efficiency * (was.id.string == 36 ? 0.8 : 1), 1e-12);
  }
  EXPECT_EQ(text_of(string), "string-efficiency of string 36");

  // Noise would make much of what no light shows of a string's place.
  const Suspect moved{"geometry-offset", {{"string", 36}}, {{{0, 1.0}}, {{1, 1.0}}, {{2, 1.0}}}, 6};
  for (const IceParameter& p : fit_parameters(moved, Eigen::Vector3d(1, 20, -20), model_)) {
    EXPECT_EQ(p.prior, 6);
    EXPECT_EQ(p.prior_centre, 0);
    EXPECT_LE(std::abs(p.start), 6);
  }

  const Suspect band{"absorption-layer", {{"depth", 1780}, {"width", 40}}, {{{0, 1.0}}}};
  const auto of_band = fit_parameters(band, Eigen::VectorXd::Constant(1, std::log(1.5)), model_);
  ASSERT_EQ(of_band.size(), 3u);
  EXPECT_EQ(of_band[0].start, 1780);
  EXPECT_EQ(of_band[1].start, 40);
  EXPECT_EQ(of_band[1].low, model_.ice->layer_step());  // thinner is the same as a smaller factor
  EXPECT_NEAR(of_band[2].start, 1.5, 1e-12);
  for (const int place : {0, 1}) {
    EXPECT_EQ(of_band[place].prior, 80);
    EXPECT_EQ(of_band[place].prior_centre, of_band[place].start);
  }
  EXPECT_EQ(of_band[2].prior, 0);
  EXPECT_EQ(text_of(band), "absorption-layer at 1760-1800 m");

  Suspect tilt{"tilt", {}, {{{0, 1.0}}, {{1, 1.0}}}};
  tilt.layers = DepthRange{1600, 2000, 2};
  const auto slopes = fit_parameters(tilt, Eigen::Vector2d(20, -1e3), model_);
  ASSERT_EQ(slopes.size(), 2u);
  EXPECT_EQ(slopes[0].depth, 1700);
  EXPECT_EQ(slopes[0].start, 20);
  EXPECT_EQ(slopes[1].start, -2 * slopes[1].scale);  // no fit begins so far off
  EXPECT_EQ(null_number(slopes[0], model_), 0);
}

}  // namespace
}  // namespace floe::test

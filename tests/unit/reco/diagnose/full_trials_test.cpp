// How whole diagnoses are scored, and what they are given that the catalogue does not have.
#include "reco/diagnose/full_trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "propagation/model.h"
#include "reco/diagnose/outside_effects.h"

namespace floe {
namespace {

HiddenEffect hidden(const std::string& effect) {
  return {effect, effect, {}, 5};
}

NamedInTrial named(const std::string& effect, const std::vector<std::string>& others = {},
                   const Place& place = {}) {
  NamedInTrial result{effect, effect, place, {effect}};
  result.group.insert(result.group.end(), others.begin(), others.end());
  return result;
}

FullTrial trial_of(const std::vector<HiddenEffect>& hidden, const std::vector<NamedInTrial>& names,
                   bool unexplained = false) {
  FullTrial trial;
  trial.hidden = hidden;
  trial.named = names;
  for (const NamedInTrial& name : names) trial.verdict.push_back(name.effect);
  if (unexplained) trial.verdict.emplace_back("unexplained");
  return trial;
}

TEST(FullTrial, IsRightByNameOrSmallGroup) {
  const std::vector<HiddenEffect> tilt{hidden("tilt")};
  EXPECT_TRUE(trial_of(tilt, {named("tilt")}).right());
  EXPECT_TRUE(trial_of(tilt, {named("tilt")}, true).right());
  EXPECT_TRUE(trial_of(tilt, {named("noise", {"tilt"})}).right());
  EXPECT_FALSE(trial_of(tilt, {named("noise", {"tilt", "hole-ice", "grains"})}).right());
  EXPECT_FALSE(trial_of(tilt, {named("noise"), named("tilt")}).right());
  EXPECT_FALSE(trial_of(tilt, {}).right());
  EXPECT_FALSE(trial_of(tilt, {}, true).right());
}

TEST(FullTrial, SaysWhenTheNameIsOfAnotherPlace) {
  HiddenEffect late = hidden("time-offset"), band = hidden("absorption-layer");
  late.place = {{"string", 36}};
  EXPECT_FALSE(trial_of({late}, {named("time-offset", {}, {{"string", 36}})}).elsewhere());
  EXPECT_FALSE(trial_of({late}, {named("noise", {"time-offset"})}).elsewhere());
  const FullTrial wrong = trial_of({late}, {named("time-offset", {}, {{"string", 37}})});
  EXPECT_TRUE(wrong.right());
  EXPECT_TRUE(wrong.elsewhere());
  const NamedInTrial here = named("time-offset", {}, {{"string", 36}}),
                     there = named("time-offset", {}, {{"string", 37}});
  EXPECT_FALSE(trial_of({late}, {here, there}).elsewhere());
  EXPECT_TRUE(trial_of({late}, {there, here}).elsewhere());
  band.place = {{"depth", 1800}, {"width", 40}};
  EXPECT_FALSE(
      trial_of({band}, {named("absorption-layer", {}, {{"depth", 1825}, {"width", 20}})}).elsewhere());
  EXPECT_TRUE(
      trial_of({band}, {named("absorption-layer", {}, {{"depth", 1835}, {"width", 20}})}).elsewhere());
}

TEST(FullTrial, BirefringenceOfLayersIsJudgedByItsMean) {
  HiddenEffect hid = hidden("birefringence");
  hid.values = {{"birefringence.strength", 1.4}};
  NamedEffect found;
  found.suspect.effect = "birefringence";
  found.parameters.resize(2);
  found.parameters[0].name = "birefringence 1775 m", found.parameters[1].name = "birefringence 1825 m";
  found.values = {1.3, 1.6}, found.errors = {0.1, 0.2};
  EXPECT_TRUE(values_of(hid, found).empty());
  found.mean = NamedEffect::Mean{"strength", 1.45, 0.1};
  const std::vector<FullTrial::Value> values = values_of(hid, found);
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].name, "birefringence.strength");
  EXPECT_EQ(values[0].hidden, 1.4);
  EXPECT_EQ(values[0].found, 1.45);
  EXPECT_EQ(values[0].error, 0.1);
}

TEST(FullTrial, OfNothingIsRightWhenSilent) {
  EXPECT_TRUE(trial_of({hidden("")}, {}).right());
  EXPECT_FALSE(trial_of({hidden("")}, {}, true).right());
  EXPECT_FALSE(trial_of({hidden("")}, {named("tilt")}).right());
}

TEST(FullTrial, OfAPairNeedsBothNames) {
  const std::vector<HiddenEffect> pair{hidden("tilt"), hidden("noise")};
  EXPECT_TRUE(trial_of(pair, {named("noise"), named("tilt")}).right());
  EXPECT_FALSE(trial_of(pair, {named("tilt")}).right());
  EXPECT_FALSE(trial_of(pair, {named("tilt"), named("tilt")}).right());
}

TEST(FullTrial, OutsideOfTheCatalogueStaysUnexplained) {
  const auto outside = [](const std::vector<NamedInTrial>& names, bool unexplained) {
    FullTrial trial = trial_of({hidden("glow")}, names, unexplained);
    trial.outside = true;
    return trial;
  };
  EXPECT_TRUE(outside({}, true).right());
  EXPECT_FALSE(outside({}, true).named_as_well());
  EXPECT_TRUE(outside({named("tilt")}, true).right());  // but said that something remains
  EXPECT_TRUE(outside({named("tilt")}, true).named_as_well());
  EXPECT_FALSE(outside({named("tilt")}, false).right());
  EXPECT_FALSE(outside({named("tilt")}, false).named_as_well());
  EXPECT_FALSE(outside({}, false).right());
}

class Outside : public ::testing::Test {
 protected:
  static constexpr int hits = 20000;
  const Model model_ = load_model({});
  const std::vector<FlasherRun> runs_ = [] {
    FlasherRun run;
    run.module = {36, 20};
    return std::vector<FlasherRun>{run};
  }();
  std::mt19937_64 random_{4};

  // Light on all modules, 0 to 2000 ns after the flash.
  std::vector<SimulatedHit> light() {
    std::vector<SimulatedHit> light;
    for (int i = 0; i < hits; ++i) {
      SimulatedHit hit{};
      hit.direction = hit.inward = Vec3f::UnitZ();
      hit.module = static_cast<std::uint32_t>(i % 20 == 0 ? i % 5000 : 100);
      hit.time = 0.1f * static_cast<float>(i);
      light.push_back(hit);
    }
    return light;
  }
  OutsideEffect draw(int number) { return draw_outside_effect(number, *model_.detector, runs_, random_); }
  static double mean_time(const std::vector<SimulatedHit>& light) {
    double sum = 0;
    for (const SimulatedHit& hit : light) sum += hit.time;
    return sum / static_cast<double>(light.size());
  }
};

TEST_F(Outside, GlowDelaysWithoutLoss) {
  auto changed = light();
  draw(0).apply(changed, runs_[0], random_);
  EXPECT_EQ(changed.size(), static_cast<std::size_t>(hits));
  // 15-30% of the hits, 200-500 ns on average.
  const double later = mean_time(changed) - mean_time(light());
  EXPECT_GT(later, 0.15 * 200 * 0.9);
  EXPECT_LT(later, 0.30 * 500 * 1.1);
}

TEST_F(Outside, CurtainTakesLightBeyondAPlane) {
  auto changed = light();
  draw(1).apply(changed, runs_[0], random_);
  std::vector<int> before(model_.detector->size()), after(before);
  for (const SimulatedHit& hit : light()) ++before[hit.module];
  for (const SimulatedHit& hit : changed) ++after[hit.module];
  int untouched = 0, less = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] > 0) ++(after[i] == before[i] ? untouched : less);
  EXPECT_GT(untouched, 50);
  EXPECT_GT(less, 50);
}

TEST_F(Outside, BrightLossSparesDimModules) {
  auto changed = light();
  draw(2).apply(changed, runs_[0], random_);
  int bright = 0, dim = 0;
  for (const SimulatedHit& hit : changed) ++(hit.module == 100 ? bright : dim);
  EXPECT_LT(bright, hits / 4);
  EXPECT_GT(dim, 0.95 * hits / 20);
}

TEST_F(Outside, LateLossSparesEarlyLight) {
  auto changed = light();
  draw(3).apply(changed, runs_[0], random_);
  const auto of_module = [](const std::vector<SimulatedHit>& some, bool early) {
    return std::count_if(some.begin(), some.end(), [&](const SimulatedHit& hit) {
      return hit.module == 100 && (hit.time < 200) == early;
    });
  };
  EXPECT_EQ(of_module(changed, true), of_module(light(), true));
  EXPECT_LT(of_module(changed, false), 0.8 * static_cast<double>(of_module(light(), false)));
}

}  // namespace
}  // namespace floe

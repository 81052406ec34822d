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

TEST(FullTrial, IsRightByNameOrSmallGroup) {
  FullTrial trial{{hidden("tilt")}, false, {"tilt"}, {{"tilt"}}, {}, 1, 0};
  EXPECT_TRUE(trial.right());
  trial.verdict = {"noise"}, trial.groups = {{"noise", "tilt"}};
  EXPECT_TRUE(trial.right());
  trial.groups = {{"noise", "tilt", "hole-ice", "grains"}};
  EXPECT_FALSE(trial.right());
  trial.verdict = {"noise", "tilt"}, trial.groups = {{"noise"}, {"tilt"}};
  EXPECT_FALSE(trial.right());
  trial.verdict = {}, trial.groups = {};
  EXPECT_FALSE(trial.right());
}

TEST(FullTrial, OfNothingIsRightWhenSilent) {
  FullTrial trial{{hidden("")}, false, {}, {}, {}, 0, 0};
  EXPECT_TRUE(trial.right());
  trial.verdict = {"unexplained"};
  EXPECT_FALSE(trial.right());
}

TEST(FullTrial, OfAPairNeedsBothNames) {
  FullTrial trial{
      {hidden("tilt"), hidden("noise")}, false, {"noise", "tilt"}, {{"noise"}, {"tilt"}}, {}, 1, 0};
  EXPECT_TRUE(trial.right());
  trial.verdict = {"tilt"}, trial.groups = {{"tilt"}};
  EXPECT_FALSE(trial.right());
}

TEST(FullTrial, OutsideOfTheCatalogueStaysUnexplained) {
  FullTrial trial{{hidden("glow")}, true, {"unexplained"}, {}, {}, 0, 0};
  EXPECT_TRUE(trial.right());
  trial.verdict = {"tilt", "unexplained"}, trial.groups = {{"tilt"}};
  EXPECT_TRUE(trial.right());  // named too much, but said that something remains
  trial.verdict = {"tilt"};
  EXPECT_FALSE(trial.right());
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

#include "reco/ice_fit/receiver_efficiencies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reco/ice_fit/ice_solution.h"
#include "tests/unit/reco/ice_fit/closed_light.h"

namespace floe {
namespace {

constexpr int receivers = 16, bins_each = 4, bins = receivers * bins_each;
constexpr double width = 0.1;

RunColumns columns_of(int nuisance, bool fitted) {
  RunColumns columns{nuisance, {}, {}};
  if (!fitted) return columns;
  for (int r = 0; r < receivers; ++r) columns.efficiency.push_back(7 + r);
  for (int b = 0; b < bins; ++b) columns.receiver_of_bin.push_back(b / bins_each);
  return columns;
}

// Two runs whose receivers' efficiencies were drawn with the width of the prior.
struct Trial {
  Eigen::Vector3d gap, errors;
  Eigen::VectorXd efficiency_gap, efficiency_errors;
};
Trial one_trial(bool fitted, std::mt19937_64& random) {
  const ClosedLight light = some_light(bins, 400, 0.2);
  const Noise noise{0, 1, 0};
  std::normal_distribution<double> normal(0, width);
  Eigen::VectorXd truth(receivers);
  for (double& change : truth) change = normal(random);
  Eigen::VectorXd mean = light.base;
  for (int b = 0; b < bins; ++b) mean(b) *= 1 + truth(b / bins_each);

  ScoreSystem system(7 + (fitted ? receivers : 0));
  for (const int nuisance : {3, 5}) {
    RunCounts counts;
    counts.data = draw(mean, 1, random);
    counts.scale = light.scale;
    const RunLight seen = simulated(light, noise, random);
    add_run(seen, seen, counts, columns_of(nuisance, fitted), system);
  }
  const ProfiledSystem profiled = profile_efficiencies(system, fitted ? receivers : 0, width);
  const IceSolution solution = solve_ice(profiled.system, free_parameters(), {0, 0, 0}, {}, 50);
  Trial trial{solution.step.head(3), solution.covariance.diagonal().cwiseSqrt(), {}, {}};
  if (fitted) {
    trial.efficiency_gap = profiled.changes(solution.step) - truth;
    trial.efficiency_errors = profiled.errors;
  }
  return trial;
}

// Mean of squared pulls of the three parameters.
double squared_pulls(bool fitted, int trials) {
  std::mt19937_64 random(23);
  double sum = 0;
  for (int i = 0; i < trials; ++i) {
    const Trial trial = one_trial(fitted, random);
    sum += trial.gap.cwiseQuotient(trial.errors).squaredNorm() / 3;
  }
  return sum / trials;
}

// The error of a mean of squares is sqrt(2 / (3 trials)) = 0.04 if the three are independent; they are
// correlated, at worst fully: 0.07.
TEST(ReceiverEfficiencies, FittedAlongTheyLeaveErrorsThatAreRight) {
  EXPECT_NEAR(squared_pulls(true, 400), 1, 4 * 0.07);
}

TEST(ReceiverEfficiencies, TakenAsKnownTheyWouldMakeErrorsTooSmall) {
  EXPECT_GT(squared_pulls(false, 100), 4);
}

TEST(ReceiverEfficiencies, AreFoundWithinTheirErrors) {
  std::mt19937_64 random(29);
  constexpr int trials = 100;
  double squares = 0, gap = 0;
  for (int i = 0; i < trials; ++i) {
    const Trial trial = one_trial(true, random);
    squares += trial.efficiency_gap.cwiseQuotient(trial.efficiency_errors).squaredNorm();
    gap += trial.efficiency_gap.norm();
  }
  // About a known step, errors are those of 3200 counts, 2%. That the step is not known adds to them what all
  // efficiencies share: their mean, 10% over sqrt(16), which brightness takes.
  EXPECT_GT(squares / (trials * receivers), 0.9);
  EXPECT_LT(gap / trials, width * std::sqrt(receivers) / 2);
}

TEST(ReceiverEfficiencies, AColumnForEachModuleOfAnyRun) {
  std::vector<char> used(10, 1);
  const auto run_of = [&](std::initializer_list<std::uint32_t> modules) {
    std::vector<SimulatedHit> hits;
    for (const std::uint32_t module : modules)
      for (int i = 0; i < 100; ++i)
        hits.push_back({module, static_cast<float>(i), 400, Vec3f::UnitX(), Vec3f::UnitX(), 0});
    return RunBins(hits, 1, used, {});
  };
  const RunBins first = run_of({2, 5}), second = run_of({5, 7});
  const RunBins* runs[] = {&first, &second};
  const EfficiencyColumns columns(runs, 10);
  EXPECT_EQ(columns.count(), 3);
  EXPECT_EQ(columns.modules(), (std::vector<std::uint32_t>{2, 5, 7}));
  EXPECT_EQ(columns.of_receivers(first), (std::vector<int>{10, 11}));
  EXPECT_EQ(columns.of_receivers(second), (std::vector<int>{11, 12}));
  EXPECT_TRUE(EfficiencyColumns().of_receivers(first).empty());
  ASSERT_EQ(first.receiver_of_bin().size(), static_cast<std::size_t>(first.size()));
  EXPECT_EQ(first.receiver_of_bin().front(), 0);
  EXPECT_EQ(first.receiver_of_bin().back(), 1);
}

}  // namespace
}  // namespace floe

// Rounds of an ice fit that are solved together.
#include "reco/ice_fit/round_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floe::test {
namespace {

// What a round sees of one parameter from where it is: a slope, and noise on the gap.
ScoreSystem seen(double truth, double at, double slope, double noise) {
  ScoreSystem system(1);
  system.gap(0) = slope * (truth - at) + noise;
  system.slope(0, 0) = system.information(0, 0) = system.noise(0, 0) = slope;
  return system;
}

// Three rounds from different places have the scatter of three times the light: a third of the variance.
TEST(RoundMemory, HasTheNoiseOfAllRounds) {
  constexpr int fits = 4000, rounds = 3;
  constexpr double truth = 1.7, slope = 25;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, std::sqrt(slope));
  double sum = 0, squares = 0;
  for (int i = 0; i < fits; ++i) {
    RoundMemory memory;
    double at = 0;
    for (int round = 0; round < rounds; ++round) {
      const ScoreSystem system = memory.with(seen(truth, at, slope, noise(random)));
      const double step = system.gap(0) / system.slope(0, 0);
      memory.move(Eigen::VectorXd::Constant(1, step));
      at += step;
    }
    sum += at - truth;
    squares += (at - truth) * (at - truth);
  }
  const double expected = 1 / (slope * rounds);
  EXPECT_NEAR(sum / fits, 0, 4 * std::sqrt(expected / fits));
  EXPECT_NEAR(squares / fits, expected, 4 * expected * std::sqrt(2.0 / fits));
}

// The noise that it claims is what gaps scatter by: rounds share the data's and have their simulations' own.
TEST(RoundMemory, KnowsWhatItsGapsScatterBy) {
  constexpr int fits = 4000, rounds = 3;
  constexpr double of_data = 9, of_simulation = 6;
  std::mt19937_64 random(8);
  std::normal_distribution<double> noise(0, 1);
  double squares = 0, claimed = 0;
  for (int i = 0; i < fits; ++i) {
    RoundMemory memory;
    const double data = std::sqrt(of_data) * noise(random);
    double gap = 0;
    for (int round = 0; round < rounds; ++round) {
      ScoreSystem system = seen(0, 0, 1, data + std::sqrt(of_simulation) * noise(random));
      system.noise(0, 0) = of_data + of_simulation;
      system.simulation_noise(0, 0) = of_simulation;
      system = memory.with(system);
      gap = system.gap(0), claimed = system.noise(0, 0);
      EXPECT_NEAR(system.simulation_noise(0, 0), of_simulation / (round + 1), 1e-9);
    }
    squares += gap * gap;
  }
  EXPECT_NEAR(claimed, of_data + of_simulation / rounds, 1e-9);
  EXPECT_NEAR(squares / fits, claimed, 4 * claimed * std::sqrt(2.0 / fits));
}

TEST(RoundMemory, IsTheMeanOfItsRounds) {
  RoundMemory memory;
  memory.with(seen(1, 0, 10, 0));
  const ScoreSystem mean = memory.with(seen(1, 0, 30, 4));
  EXPECT_DOUBLE_EQ(mean.gap(0), 22);
  EXPECT_DOUBLE_EQ(mean.slope(0, 0), 20);
  EXPECT_DOUBLE_EQ(mean.information(0, 0), 20);
  EXPECT_DOUBLE_EQ(mean.noise(0, 0), 20);
}

// Whatever the slope of a round was, once the fit is at the truth its gap is none.
TEST(RoundMemory, HasTheGapsWhereTheFitIs) {
  RoundMemory memory;
  memory.with(seen(1, 0.2, 10, 0));
  memory.move(Eigen::VectorXd::Constant(1, 0.8));
  EXPECT_NEAR(memory.with(seen(1, 1, 30, 0)).gap(0), 0, 1e-12);
}

TEST(RoundMemory, StartsAgainWhereItForgot) {
  RoundMemory memory;
  memory.with(seen(1, 0, 10, 5));
  memory.forget();
  memory.move(Eigen::VectorXd::Constant(1, 0.5));  // of nothing
  EXPECT_DOUBLE_EQ(memory.with(seen(1, 0, 30, 0)).gap(0), 30);
}

}  // namespace
}  // namespace floe::test

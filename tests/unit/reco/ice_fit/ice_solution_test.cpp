#include "reco/ice_fit/ice_solution.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace floe {
namespace {

// Parameters of one family, in order of depth, wherever the numbers may go.
std::vector<IceParameter> family(const std::string& name, int count) {
  std::vector<IceParameter> parameters(static_cast<std::size_t>(count));
  for (IceParameter& parameter : parameters) {
    parameter.scale = 1;
    parameter.family = name;
    parameter.low = -100, parameter.high = 100;
  }
  return parameters;
}

// Parameters that the light knows one by one, each to be `best` with this error (infinite: it knows nothing),
// and one run's brightness and time zero.
ScoreSystem known(const Eigen::VectorXd& best, const Eigen::VectorXd& errors) {
  const Eigen::Index count = best.size();
  ScoreSystem system(static_cast<int>(count) + 2);
  system.information.diagonal().head(count) = errors.cwiseAbs2().cwiseInverse();
  system.information.diagonal().tail(2).setConstant(1e4);
  system.noise = system.information;
  system.gap.head(count) = system.information.diagonal().head(count).cwiseProduct(best);
  return system;
}

const double inf = std::numeric_limits<double>::infinity();

TEST(IceSolution, WithoutPriorsIsTheSolutionOfTheEquations) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd root(6, 6), noise(6, 6);
  ScoreSystem system(6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    system.gap(i) = normal(random);
    for (Eigen::Index k = 0; k < 6; ++k) root(i, k) = normal(random), noise(i, k) = normal(random);
  }
  const Eigen::MatrixXd slope = root * root.transpose() + 10 * Eigen::MatrixXd::Identity(6, 6);
  system.information = slope;
  system.noise = noise * noise.transpose() + Eigen::MatrixXd::Identity(6, 6);
  const auto parameters = family("", 4);  // of no family: no priors
  const IceSolution solution = solve_ice(system, parameters, {0, 0, 0, 0}, {}, 10);
  EXPECT_TRUE(solution.step.isApprox(slope.lu().solve(system.gap), 1e-4)) << solution.step.transpose();
  const Eigen::MatrixXd inverse = slope.inverse();
  const Eigen::MatrixXd covariance = inverse * system.noise * inverse.transpose();
  EXPECT_TRUE(solution.covariance.isApprox(covariance.topLeftCorner(4, 4), 1e-4));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(solution.light_errors[i] / std::sqrt(covariance(k, k)), 1, 1e-4);
  }
}

// Where there is no light a parameter lies between its neighbours, for which it is as uncertain as the prior.
TEST(IceSolution, SmoothnessFillsGapsInTheLight) {
  const ScoreSystem system = known(Eigen::Vector4d(0.3, 0, 0, 0.6), Eigen::Vector4d(0.01, inf, inf, 0.01));
  const IceSolution solution = solve_ice(system, family("absorption", 4), {0, 0, 0, 0}, {0.2, 50}, 10);
  EXPECT_NEAR(solution.step(0), 0.3, 1e-3);
  EXPECT_NEAR(solution.step(1), 0.4, 1e-3);
  EXPECT_NEAR(solution.step(2), 0.5, 1e-3);
  EXPECT_NEAR(solution.step(3), 0.6, 1e-3);
  // One step of the walk from one side, two from the other: variances 1 and 2 in parallel.
  EXPECT_NEAR(std::sqrt(solution.covariance(1, 1)), 0.2 * std::sqrt(2.0 / 3), 1e-3);
}

// Smoothness is that of the numbers, not of the step.
TEST(IceSolution, SmoothnessLooksAtTheNumbers) {
  const ScoreSystem system = known(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.01, inf, 0.01));
  const IceSolution solution = solve_ice(system, family("absorption", 3), {0.4, -0.2, 0.8}, {0.2, 50}, 10);
  EXPECT_NEAR(solution.step(1), 0.8, 1e-3);  // to 0.6
}

TEST(IceSolution, FamiliesAreNotTiedToEachOther) {
  auto parameters = family("absorption", 2);
  parameters[1].family = "scattering";
  const ScoreSystem system = known(Eigen::Vector2d(0.5, 0), Eigen::Vector2d(0.001, inf));
  const IceSolution solution = solve_ice(system, parameters, {0, 0.3}, {0.01, 1}, 10);
  EXPECT_NEAR(solution.step(0), 0.5, 1e-3);
  EXPECT_NEAR(solution.step(1), -0.3, 1e-3);  // back to its start
}

TEST(IceSolution, PriorsAboutTheStart) {
  auto parameters = family("absorption", 3);
  parameters[0].family = "a", parameters[1].family = "b", parameters[2].family = "";
  parameters[1].prior = 0.1;
  for (IceParameter& parameter : parameters) parameter.start = 1;
  // The light says 2 within 0.1 to all three, which stand at 1.5.
  const ScoreSystem system = known(Eigen::Vector3d(0.5, 0.5, 0.5), Eigen::Vector3d(0.1, 0.1, 0.1));
  const IceSolution solution = solve_ice(system, parameters, {1.5, 1.5, 1.5}, {0.5, 0.2}, 10);
  EXPECT_NEAR(1.5 + solution.step(0), (2 * 100 + 1 * 25) / 125.0, 1e-4);  // the family's amplitude
  EXPECT_NEAR(1.5 + solution.step(1), 1.5, 1e-4);                         // its own prior
  EXPECT_NEAR(1.5 + solution.step(2), 2, 1e-4);                           // none
  EXPECT_NEAR(solution.covariance(0, 0), 1 / 125.0, 1e-5);
  EXPECT_NEAR(solution.covariance(1, 1), 1 / 200.0, 1e-5);
  EXPECT_NEAR(solution.light_errors[1], 0.1, 1e-5);  // whatever the priors
}

// A fit that goes on where another ended has the same prior, not one about what the data have said.
TEST(IceSolution, PriorsStayWhereTheyWere) {
  auto parameters = family("absorption", 1);
  parameters[0].begin_at(0.8);
  parameters[0].begin_at(1);
  const ScoreSystem system = known(Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Constant(1, 0.2));
  const IceSolution solution = solve_ice(system, parameters, {1}, {0.5, 0.2}, 10);
  EXPECT_NEAR(1 + solution.step(0), 0.75, 1e-3);  // between 1.5 and 0
}

TEST(IceSolution, LimitsAndTheLongestStepAreKept) {
  auto parameters = family("", 5);
  for (IceParameter& parameter : parameters) parameter.low = -1, parameter.high = 1;
  Eigen::VectorXd best(5), errors = Eigen::VectorXd::Constant(5, 0.1);
  best << 0.5, -0.6, 5, -5, 0.2;
  const IceSolution solution = solve_ice(known(best, errors), parameters, {0.8, -0.9, 0, 0, 0}, {}, 0.7);
  EXPECT_NEAR(solution.step(0), 0.2, 1e-5);
  EXPECT_NEAR(solution.step(1), -0.1, 1e-5);
  EXPECT_NEAR(solution.step(2), 0.7, 1e-5);
  EXPECT_NEAR(solution.step(3), -0.7, 1e-5);
  EXPECT_NEAR(solution.step(4), 0.2, 1e-4);
  for (Eigen::Index i = 0; i < 5; ++i) EXPECT_LE(std::abs(solution.step(i)), 0.7);
}

// Two flashers know nothing of a band far above them, and no prior does: its error is large, not 0.
TEST(IceSolution, WhatNothingTellsOfIsNotKnown) {
  const ScoreSystem system = known(Eigen::Vector2d(0.5, 0), Eigen::Vector2d(0.1, inf));
  const IceSolution solution = solve_ice(system, family("", 2), {0, 0}, {}, 10);
  EXPECT_NEAR(std::sqrt(solution.covariance(0, 0)), 0.1, 1e-4);
  EXPECT_NEAR(solution.step(1), 0, 1e-6);
  EXPECT_GT(std::sqrt(solution.covariance(1, 1)), 100);
  EXPECT_TRUE(std::isinf(solution.light_errors[1]));
}

// A run's brightness and time zero are held, too.
TEST(IceSolution, BrightnessAndTimeZeroKeepTheirLongestSteps) {
  ScoreSystem system = known(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 0.1));
  system.gap.tail(2) << 1e4 * 3, -1e4 * 50;
  const IceSolution solution = solve_ice(system, family("", 1), {0}, {}, 0.7);
  EXPECT_NEAR(solution.step(1), 0.7, 1e-5);
  EXPECT_NEAR(solution.step(2), -20, 1e-4);
}

// At limits that several correlated parameters meet, the others take their best places given these: no
// gradient along what is free, and one outwards at each limit.
TEST(IceSolution, IsTheBestWithinItsLimits) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  constexpr Eigen::Index count = 20, size = count + 2;
  int at_limits = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd root(size, 40);
    for (Eigen::Index i = 0; i < root.size(); ++i) root.data()[i] = 10 * (normal(random) + 1);
    ScoreSystem system(size);
    system.information = system.noise = root * root.transpose();
    Eigen::VectorXd best(size);
    for (Eigen::Index i = 0; i < size; ++i) best(i) = 0.4 * normal(random);
    system.gap = system.information * best;
    auto parameters = family("", count);
    for (IceParameter& parameter : parameters) parameter.low = -0.3, parameter.high = 0.3;
    const IceSolution solution =
        solve_ice(system, parameters, std::vector<double>(std::size_t{count}, 0.0), {}, 10);
    const Eigen::VectorXd gradient = system.information * solution.step - system.gap;
    for (Eigen::Index i = 0; i < size; ++i) {
      // In units of what one standard deviation of this parameter alone makes.
      const double slope = gradient(i) / std::sqrt(system.information(i, i));
      const double limit = i < count ? 0.3 : i == count ? 0.7 : 20;
      const bool above = solution.step(i) > limit - 1e-6, below = solution.step(i) < 1e-6 - limit;
      at_limits += above || below;
      EXPECT_LT(below ? -slope : above ? slope : std::abs(slope), 0.02) << trial << " " << i;
    }
  }
  EXPECT_GT(at_limits, 100);
}

TEST(IceSolution, ErrorsAreInfiniteWithoutLight) {
  const ScoreSystem system = known(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, inf, 20));
  const IceSolution solution = solve_ice(system, family("absorption", 3), {0, 0, 0}, {0.5, 1}, 10);
  EXPECT_NEAR(solution.light_errors[0], 0.1, 1e-4);
  EXPECT_EQ(solution.light_errors[1], inf);
  EXPECT_NEAR(solution.light_errors[2], 20, 0.1);
  EXPECT_LT(std::sqrt(solution.covariance(1, 1)), 1);  // the priors know it
}

// Whatever the other numbers are; runs that are not there tell nothing of their own.
TEST(IceSolution, InformationAboutTheIceIsThatOfItsErrors) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd root(6, 6);
  for (Eigen::Index i = 0; i < 36; ++i) root(i / 6, i % 6) = normal(random);
  ScoreSystem system(8);
  const Eigen::MatrixXd light = root * root.transpose() + Eigen::MatrixXd::Identity(6, 6);
  system.information.topLeftCorner(6, 6) = light;
  const Eigen::MatrixXd covariance = light.inverse().topLeftCorner(4, 4);
  EXPECT_TRUE(information_about_ice(system, 4).isApprox(covariance.inverse(), 1e-6));
}

// Light that knows only differences between parameters does not know any of them, however many they are.
TEST(IceSolution, ErrorsAreInfiniteWhereOnlyDifferencesAreKnown) {
  for (const int count : {2, 20}) {
    ScoreSystem system(count + 2);
    const Eigen::MatrixXd even = Eigen::MatrixXd::Constant(count, count, 1.0 / count);
    system.information.topLeftCorner(count, count) = 100 * (Eigen::MatrixXd::Identity(count, count) - even);
    system.information.diagonal().tail(2).setConstant(100);
    system.noise = system.information;
    const IceSolution solution = solve_ice(system, family("absorption", count),
                                           std::vector<double>(static_cast<std::size_t>(count), 0.0), {}, 10);
    for (const double error : solution.light_errors) EXPECT_EQ(error, inf) << count;
  }
}

}  // namespace
}  // namespace floe

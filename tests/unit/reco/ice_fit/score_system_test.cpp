#include "reco/ice_fit/score_system.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <random>
#include <string>

#include "reco/ice_fit/ice_solution.h"
#include "tests/unit/reco/ice_fit/closed_light.h"

namespace floe {
namespace {

void add(const RunLight& light, const RunCounts& counts, int nuisance, ScoreSystem& system) {
  add_run(light, light, counts, {nuisance, {}, {}}, system);
}

Eigen::MatrixXd all_slopes(const ClosedLight& light) {
  Eigen::MatrixXd slopes(light.base.size(), 5);
  slopes << light.slopes, Eigen::VectorXd::Ones(light.base.size()), light.delay;
  return slopes;
}

TEST(ScoreSystem, IsTheFisherInformationWhereNothingIsNoisy) {
  const ClosedLight light = some_light(24, 50, 1e-9);
  RunCounts counts;
  counts.data = light.base + Eigen::VectorXd::LinSpaced(24, -5, 8);
  counts.scale = light.scale;
  ScoreSystem system(5);
  add(certain(light), counts, 3, system);
  const Eigen::MatrixXd slopes = all_slopes(light);
  const Eigen::MatrixXd information = slopes.transpose() * light.base.asDiagonal() * slopes;
  EXPECT_TRUE(system.slope.isApprox(information, 1e-6));
  EXPECT_TRUE(system.information.isApprox(information, 1e-6));
  EXPECT_TRUE(system.noise.isApprox(information, 1e-6));
  EXPECT_TRUE(system.gap.isApprox(slopes.transpose() * (counts.data - light.base), 1e-6));
}

// Two folds of L times the light of the data each blur mu by mu/(2 L): the information of counts whose
// variance is mu (1 + 1/(2 L)).
TEST(ScoreSystem, SimulatedNoiseTakesInformationAway) {
  const ClosedLight light = some_light(24, 50, 0.4);
  RunCounts counts;
  counts.data = light.base;
  counts.scale = light.scale;
  ScoreSystem system(5);
  add(certain(light), counts, 3, system);
  const Eigen::MatrixXd slopes = all_slopes(light);
  const Eigen::MatrixXd information = slopes.transpose() * (light.base / 1.2).asDiagonal() * slopes;
  EXPECT_TRUE(system.slope.isApprox(information, 1e-9));
  EXPECT_TRUE(system.information.isApprox(information, 1e-9));
  EXPECT_TRUE(system.noise.isApprox(information, 1e-9));
  EXPECT_LT(system.gap.norm(), 1e-9);
}

TEST(ScoreSystem, ModelErrorTakesInformationAway) {
  const ClosedLight light = some_light(24, 50, 1e-9);
  RunCounts counts;
  counts.data = light.base;
  counts.scale = light.scale;
  counts.model_error = 0.1;
  ScoreSystem system(5);
  add(certain(light), counts, 3, system);
  const Eigen::ArrayXd known = light.base.array() / (1 + 0.01 * light.base.array());
  const Eigen::MatrixXd slopes = all_slopes(light);
  const Eigen::MatrixXd information = slopes.transpose() * known.matrix().asDiagonal() * slopes;
  EXPECT_TRUE(system.slope.isApprox(information, 1e-6));
  EXPECT_TRUE(system.information.isApprox(information, 1e-6));
  EXPECT_TRUE(system.noise.isApprox(information, 1e-6));
}

TEST(ScoreSystem, RunsShareTheIceAndHaveTheirOwnBrightness) {
  const ClosedLight light = some_light(24, 50, 0.1);
  RunCounts counts;
  counts.data = light.base;
  counts.scale = light.scale;
  ScoreSystem one(5), both(7);
  add(certain(light), counts, 3, one);
  add(certain(light), counts, 3, both);
  add(certain(light), counts, 5, both);
  EXPECT_TRUE(both.slope.topLeftCorner(3, 3).isApprox(2 * one.slope.topLeftCorner(3, 3)));
  for (const Eigen::Index run : {3, 5}) {
    EXPECT_TRUE(both.slope.block(run, run, 2, 2).isApprox(one.slope.block(3, 3, 2, 2)));
    EXPECT_TRUE(both.slope.block(0, run, 3, 2).isApprox(one.slope.block(0, 3, 3, 2)));
    EXPECT_TRUE(both.noise.block(run, 0, 2, 3).isApprox(one.noise.block(3, 0, 2, 3)));
  }
  EXPECT_EQ(both.slope.block(3, 5, 2, 2).norm(), 0);
  EXPECT_EQ(both.noise.block(5, 3, 2, 2).norm(), 0);
}

// Slopes that are noise weigh nothing: without Stein's argument the noise would count as information.
TEST(ScoreSystem, SlopesOfNoiseWeighLittle) {
  const ClosedLight light = some_light(24, 50, 1);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  double taken = 0;
  constexpr int trials = 100;
  for (int trial = 0; trial < trials; ++trial) {
    RunLight run = certain(light);
    for (LightFold& fold : run.folds)
      for (int b = 0; b < 24; ++b) {
        fold.slopes(b, 0) = 20 * std::sqrt(fold.counts(b)) * normal(random);
        fold.slope_squares(b, 0) = 400 * fold.counts(b);
      }
    RunCounts counts;
    counts.data = light.base;
    ScoreSystem system(5);
    add(run, counts, 3, system);
    taken += system.noise(0, 0) / trials;
  }
  // Taken at face value, noise of variance 400/counts is worth 400 in each of 24 bins. Left of it is the
  // share power/(power + noise), squared: the power of pure noise is 0.2 of it at one sigma, so 0.02 or so.
  EXPECT_LT(taken, 0.06 * 24 * 400);
}

// Of two parameters at one place light shows one combination; the other's weights are noise, and go.
TEST(ScoreSystem, CombinationsKeepWhatSlopesConfirm) {
  const Eigen::Rotation2Dd turned(0.7);
  const auto along = [&](double first, double second) -> Eigen::Matrix2d {
    return turned.toRotationMatrix() * Eigen::Vector2d(first, second).asDiagonal() *
           turned.inverse().toRotationMatrix();
  };
  ScoreSystem system(4);
  system.information.setConstant(3);
  system.information.bottomRightCorner(2, 2) = along(100, 2);
  system.noise = system.information;
  system.slope = system.information;
  system.slope.bottomRightCorner(2, 2) = along(120, 0.1);
  system.gap << 1, 2, 30, 20;
  const ScoreSystem before = system;
  shrink_combinations({"", "elsewhere", "here", "here"}, system);

  const double share = 0.05;  // at most all of it, and a twentieth
  EXPECT_TRUE(system.information.bottomRightCorner(2, 2).isApprox(along(100, 2 * share * share)));
  EXPECT_TRUE(system.noise.bottomRightCorner(2, 2).isApprox(along(100, 2 * share * share)));
  EXPECT_TRUE(system.slope.bottomRightCorner(2, 2).isApprox(along(120, 0.1 * share)));
  EXPECT_TRUE(system.gap.tail(2).isApprox(along(1, share) * before.gap.tail(2)));
  EXPECT_TRUE(system.gap.head(2).isApprox(before.gap.head(2)));
  EXPECT_TRUE(system.slope.topRows(2).isApprox(before.slope.topRows(2)));
  EXPECT_TRUE(system.information.topLeftCorner(2, 2).isApprox(before.information.topLeftCorner(2, 2)));
}

// Whatever single slopes say, a group's information adds up to theirs; other columns stay.
TEST(ScoreSystem, InformationIsCalibratedByGroups) {
  ScoreSystem system(5);
  system.information = Eigen::MatrixXd::Constant(5, 5, 1) + Eigen::MatrixXd::Identity(5, 5);
  system.slope.diagonal() << 1, 1.5, 9, 7, 7;
  calibrate_information({"absorption", "absorption", "flow-azimuth"}, system);
  EXPECT_NEAR(system.information(0, 0), 2 * 2.5 / 4, 1e-12);
  EXPECT_NEAR(system.information(1, 1), 2 * 2.5 / 4, 1e-12);
  EXPECT_NEAR(system.information(0, 1), 2.5 / 4, 1e-12);
  EXPECT_NEAR(system.information(2, 2), 2 * 1.5, 1e-12);  // no further than that
  EXPECT_NEAR(system.information(0, 2), std::sqrt(2.5 / 4 * 1.5), 1e-12);
  EXPECT_NEAR(system.information(3, 3), 2, 1e-12);
  EXPECT_NEAR(system.information(0, 4), std::sqrt(2.5 / 4), 1e-12);
}

class SolvedParameters : public ::testing::TestWithParam<Noise> {};

// Two runs of some ten thousand counts, simulated with five times the light: the step leads to the truth,
// with the errors that it says. Close to it noise of the slopes, however large, does neither bias the step
// nor widen it.
TEST_P(SolvedParameters, AreUnbiasedWithTheScatterOfTheirCovariance) {
  const Noise noise = GetParam();
  const ClosedLight light = some_light(30, 600, 0.4);
  const Eigen::Vector3d truth = noise.away * Eigen::Vector3d(0.08, -0.06, 0.1);
  const Eigen::VectorXd mean =
      light.base.cwiseProduct((Eigen::VectorXd::Ones(light.base.size()) + light.slopes * truth).eval());
  std::mt19937_64 random(17);
  constexpr int trials = 600;
  Eigen::Vector3d pulls = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  double chi_square = 0;
  for (int trial = 0; trial < trials; ++trial) {
    ScoreSystem system(7);
    for (const int nuisance : {3, 5}) {
      RunCounts counts;
      counts.data = draw(mean, noise.seen, random);
      counts.scale = light.scale;
      counts.dispersion = counts.data_dispersion = noise.seen;
      add(simulated(light, noise, random), counts, nuisance, system);
    }
    const IceSolution solution = solve_ice(system, free_parameters(), {0, 0, 0}, {}, 50);
    const Eigen::Vector3d gap = solution.step.head(3) - truth;
    for (int p = 0; p < 3; ++p) {
      const double pull = gap(p) / std::sqrt(solution.covariance(p, p));
      pulls(p) += pull / trials;
      squares(p) += pull * pull / trials;
      EXPECT_NEAR(solution.light_errors[static_cast<std::size_t>(p)] / std::sqrt(solution.covariance(p, p)),
                  1, 1e-3);
    }
    chi_square += gap.dot(solution.covariance.inverse() * gap) / (3 * trials);
  }
  // Means of pulls have an error of 1/sqrt(trials) = 0.04, so that a bias of 0.16 sigma is seen; squared
  // widths one of sqrt(2/trials) = 0.06, so that errors wrong by an eighth are. On a long step what the
  // slopes do not know adds some per cent that the covariance does not count.
  for (int p = 0; p < 3; ++p) {
    EXPECT_NEAR(pulls(p), 0, 4 / std::sqrt(trials)) << p;
    EXPECT_NEAR(squares(p), 1, 4 * std::sqrt(2.0 / trials) + 0.03) << p;
  }
  EXPECT_NEAR(chi_square, 1, 4 * std::sqrt(2.0 / (3 * trials)) + 0.03);
}

INSTANTIATE_TEST_SUITE_P(Noises, SolvedParameters,
                         ::testing::Values(Noise{0, 1, 1}, Noise{2, 1, 1}, Noise{2, 3, 1}, Noise{0, 1, 0},
                                           Noise{6, 1, 0}, Noise{9, 1, 0}, Noise{4, 3, 0}),
                         [](const auto& noise) {
                           return "scatter" + std::to_string(static_cast<int>(noise.param.slopes)) + "_seen" +
                                  std::to_string(noise.param.seen) + (noise.param.away > 0 ? "_away" : "");
                         });

}  // namespace
}  // namespace floe

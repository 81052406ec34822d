#include "reco/direct_fit/poisson_regression.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <random>

#include "reco/direct_fit/design.h"

namespace floe {
namespace {

RegressionPrior wide_prior() {
  return {Coefficients::Zero(), Coefficients::Constant(100)};
}

std::vector<RegressionPoint> points_of_three_rounds() {
  std::vector<RegressionPoint> points;
  for (std::uint64_t draw = 0; draw < 3; ++draw)
    for (const Coordinates& place : simplex_design(1, draw)) points.push_back({place, 0.1 * double(draw)});
  return points;
}

TEST(SimplexDesign, KnowsAllSlopesEquallyWellAndIsSymmetric) {
  const auto design = simplex_design(7, 3);
  ASSERT_EQ(design.size(), 13u);
  Coordinates sum = Coordinates::Zero();
  Eigen::Matrix<double, 5, 5> square = Eigen::Matrix<double, 5, 5>::Zero();
  for (const Coordinates& place : design) sum += place, square += place * place.transpose();
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_LT((square - square(0, 0) * Eigen::Matrix<double, 5, 5>::Identity()).norm(), 1e-9);
  EXPECT_NEAR((design[1] - design[3]).norm(), (design[5] - design[11]).norm(), 1e-9);
}

TEST(PoissonRegression, PullsAreStandardNormal) {
  const auto points = points_of_three_rounds();
  const Coefficients truth = (Coefficients() << 2.5, 0.1, -0.2, 0.05, 0.3, -0.1).finished();
  std::mt19937 random(11);
  double square = 0;
  constexpr int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> counts;
    for (const RegressionPoint& point : points) {
      const double mean = std::exp(point.offset + truth(0) + truth.tail<5>().dot(point.place));
      counts.push_back(std::poisson_distribution<int>(mean)(random));
    }
    const Regression fit = fit_poisson(points, counts, wide_prior());
    const Coefficients gap = fit.coefficients - truth;
    square += gap.dot(fit.covariance.inverse() * gap);
  }
  // Chi-square of 6 x trials degrees of freedom; 4 sigma, and small-count corrections of some per cent.
  EXPECT_NEAR(square / (6 * trials), 1, 4 * std::sqrt(2.0 / (6 * trials)) + 0.03);
}

TEST(PoissonRegression, WithoutCountsFallsBackOnThePrior) {
  const auto points = points_of_three_rounds();
  const std::vector<double> counts(points.size(), 0);
  RegressionPrior prior{Coefficients::Zero(), Coefficients::Constant(0.5)};
  prior.mean(0) = -8;
  prior.mean(2) = 0.3;
  const Regression fit = fit_poisson(points, counts, prior);
  EXPECT_NEAR(fit.coefficients(0), -8, 0.05);
  EXPECT_NEAR(fit.coefficients(2), 0.3, 0.02);
}

TEST(PoissonRegression, SeesWhatALogLinearModelCannotFollow) {
  const auto points = points_of_three_rounds();
  std::mt19937 random(2);
  std::vector<double> straight, curved;
  for (const RegressionPoint& point : points) {
    straight.push_back(
        std::poisson_distribution<int>(2000 * std::exp(point.offset + 0.2 * point.place(1)))(random));
    const double bend = 0.3 * point.place(0) * point.place(2);
    curved.push_back(std::poisson_distribution<int>(2000 * std::exp(point.offset + bend))(random));
  }
  EXPECT_LT(fit_poisson(points, straight, wide_prior()).excess_variance, 2e-4);
  EXPECT_GT(fit_poisson(points, curved, wide_prior()).excess_variance, 5e-3);
}

}  // namespace
}  // namespace floe

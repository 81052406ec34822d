#include "reco/ice_fit/smooth_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reco/ice_fit/run_light.h"

namespace floe {
namespace {

constexpr Eigen::Index bin_count = 200;

Eigen::MatrixXd some_places() {
  Eigen::MatrixXd places(bin_count, 4);
  for (Eigen::Index b = 0; b < bin_count; ++b) {
    const double x = 2.0 * static_cast<double>(b) / (bin_count - 1) - 1;
    places.row(b) << 1, x, std::cos(7 * x), x * x;
  }
  return places;
}
std::vector<char> all_symmetric(const LightFold (&folds)[2]) {
  return std::vector<char>(static_cast<std::size_t>(folds[0].slopes.cols()), 1);
}
Eigen::VectorXd dwell_of(Eigen::Index b) {
  return Eigen::VectorXd::Constant(1, 20 + 15 * std::sin(0.1 * static_cast<double>(b)));
}

// Folds of `hits` a bin with these true slopes and scores that scatter by `sigma`.
void draw(const Eigen::VectorXd& truth, double hits, double sigma, std::mt19937_64& random,
          LightFold (&folds)[2]) {
  std::normal_distribution<double> normal;
  for (LightFold& fold : folds) {
    fold = {Eigen::VectorXd::Constant(bin_count, hits), hits * truth,
            hits * (truth.cwiseAbs2().array() + sigma * sigma).matrix(), Eigen::MatrixXd(bin_count, 1),
            Eigen::VectorXd::Zero(bin_count)};
    for (Eigen::Index b = 0; b < bin_count; ++b) {
      fold.slopes(b, 0) += std::sqrt(hits) * sigma * normal(random);
      fold.dwell.row(b) = hits * dwell_of(b);
    }
  }
}

// A smooth function of the place, in proportion to the dwell.
Eigen::VectorXd smooth_truth() {
  const Eigen::MatrixXd places = some_places();
  Eigen::VectorXd truth(bin_count);
  for (Eigen::Index b = 0; b < bin_count; ++b)
    truth(b) = dwell_of(b)(0) / 20 * (0.1 + 0.05 * places(b, 1) - 0.08 * places(b, 2));
  return truth;
}

double power(const Eigen::VectorXd& x) {
  return x.squaredNorm() / static_cast<double>(x.size());
}

TEST(SmoothSlopes, AreTheSlopesWhereNothingIsNoisy) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd truth(bin_count);  // nothing smooth about it
  for (Eigen::Index b = 0; b < bin_count; ++b) truth(b) = normal(random);
  LightFold folds[2];
  draw(truth, 30, 0, random, folds);
  const SmoothSlopes slopes = smooth_slopes(folds, some_places(), all_symmetric(folds));
  for (const auto& fold : slopes.fold) EXPECT_TRUE(fold.col(0).isApprox(truth, 1e-6));
}

// Noise of bin by bin, ten times the slopes, is averaged out where the slopes are smooth: left of it are the
// seven terms that are fitted, of 200 bins.
TEST(SmoothSlopes, AverageNoiseOut) {
  std::mt19937_64 random(2);
  const Eigen::VectorXd truth = smooth_truth();
  const double sigma = 10 * std::sqrt(power(truth));
  double left = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    LightFold folds[2];
    draw(truth, 30, sigma * std::sqrt(30.0), random, folds);
    const SmoothSlopes slopes = smooth_slopes(folds, some_places(), all_symmetric(folds));
    for (const auto& fold : slopes.fold) left += power(fold.col(0) - truth) / (2 * trials);
  }
  EXPECT_LT(left, 0.03 * sigma * sigma);
}

// The weights' square is worth what they find of the slopes: a fit's information is neither made up nor lost.
TEST(SmoothSlopes, SayOnAverageWhatTheSlopesAre) {
  for (const double noise : {0.3, 1.0, 3.0}) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    Eigen::VectorXd truth = smooth_truth();
    const double usual = std::sqrt(power(truth));
    for (Eigen::Index b = 0; b < bin_count; ++b) truth(b) += 0.5 * usual * normal(random);
    double found = 0, claimed = 0;
    for (int trial = 0; trial < 50; ++trial) {
      LightFold folds[2];
      draw(truth, 30, noise * usual * std::sqrt(30.0), random, folds);
      const SmoothSlopes slopes = smooth_slopes(folds, some_places(), all_symmetric(folds));
      for (const auto& fold : slopes.fold) {
        found += fold.col(0).dot(truth);
        claimed += fold.col(0).squaredNorm();
      }
    }
    EXPECT_NEAR(found / claimed, 1, 0.1) << noise;
  }
}

// What acts on a tenth of the bins is found there as if there were no others: a fit's information, which is
// the sum of weights times slopes, is that of the slopes, but for what noise of one bin takes (a fifth,
// shared by the few terms of a smooth slope).
TEST(SmoothSlopes, OfAFewBinsAreNotDilutedByAllOthers) {
  std::mt19937_64 random(5);
  constexpr Eigen::Index first = 80, few = 20;
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(bin_count);
  for (Eigen::Index b = first; b < first + few; ++b) truth(b) = 0.02 * (static_cast<double>(b - first) - 9.5);
  const double sigma = 0.5 * std::sqrt(truth.squaredNorm() / few) * std::sqrt(30.0);
  double information = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    LightFold folds[2];
    draw(truth, 30, sigma, random, folds);
    for (LightFold& fold : folds)
      for (Eigen::Index b = 0; b < bin_count; ++b)
        if (b < first || b >= first + few)
          fold.dwell(b, 0) = fold.slopes(b, 0) = fold.slope_squares(b, 0) = 0;
    const SmoothSlopes slopes = smooth_slopes(folds, some_places(), {0});
    for (const auto& fold : slopes.fold) {
      information += fold.col(0).dot(truth) / (2 * trials);
      EXPECT_EQ(fold.col(0).head(first).norm(), 0);
      EXPECT_EQ(fold.col(0).tail(bin_count - first - few).norm(), 0);
    }
  }
  EXPECT_GT(information, 0.8 * truth.squaredNorm());
  EXPECT_LT(information, 1.1 * truth.squaredNorm());
}

TEST(SmoothSlopes, AreNothingWhereThereIsNothing) {
  std::mt19937_64 random(4);
  double left = 0;
  constexpr int trials = 100;
  for (int trial = 0; trial < trials; ++trial) {
    LightFold folds[2];
    draw(Eigen::VectorXd::Zero(bin_count), 30, std::sqrt(30.0), random, folds);
    const SmoothSlopes slopes = smooth_slopes(folds, some_places(), all_symmetric(folds));
    for (const auto& fold : slopes.fold) left += power(fold.col(0)) / (2 * trials);
  }
  EXPECT_LT(left, 0.03);  // of 1
}

}  // namespace
}  // namespace floe

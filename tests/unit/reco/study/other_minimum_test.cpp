#include "reco/direct_fit/other_minimum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace floe {
namespace {

CascadeParameters somewhere() {
  return {{10, 20, -300}, 500, 1.1, 0.4, 1e4};
}

TEST(Displacement, IsTheDifferenceForSmallSteps) {
  CascadeParameters to = somewhere();
  to.position += Vec3(1, -2, 3);
  to.time += 4;
  to.zenith += 2e-5;
  to.azimuth -= 3e-5;
  to.energy *= 1.1;
  const Vector7 way = displacement(somewhere(), to);
  const Vector7 plain = to_vector(to) - to_vector(somewhere());
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(way(i), plain(i), 1e-9) << i;
}

TEST(Displacement, GoesTheShortWayRound) {
  CascadeParameters from = somewhere(), to = somewhere();
  from.azimuth = 0.1;
  to.azimuth = 2 * pi - 0.1;
  EXPECT_LT(displacement(from, to)(5), 0);
  EXPECT_NEAR(displacement(from, to)(5), -0.2, 0.01);
}

TEST(Displacement, IsAsLongAsTheAngleBetween) {
  CascadeParameters to = somewhere();
  to.zenith = 2.6;
  to.azimuth = 3.9;
  const Vector7 way = displacement(somewhere(), to);
  EXPECT_NEAR(std::hypot(way(4), way(5) * std::sin(somewhere().zenith)), angle_between(somewhere(), to),
              1e-12);
}

// What the share is an average of: 1 / (1 + exp(delta)) over a Gaussian delta.
TEST(OtherMinimum, ShareAveragesOverTheErrorOfTheDifference) {
  for (const double delta : {0.0, 1.0, 3.0})
    for (const double error : {0.0, 1.0, 3.0}) {
      double sum = 0, weights = 0;
      for (double u = -6; u <= 6; u += 0.01) {
        const double weight = std::exp(-0.5 * u * u);
        sum += weight / (1 + std::exp(delta + error * u));
        weights += weight;
      }
      EXPECT_NEAR(share_of({{}, delta, error}), sum / weights, 0.02) << delta << " " << error;
    }
}

TEST(OtherMinimum, AddsTheWayToTheCovariance) {
  CascadeParameters other = somewhere();
  other.position += Vec3(20, 0, 0);
  other.time += 10;
  const Matrix7 local = Matrix7::Identity();
  const Matrix7 both = with_other_minimum(local, somewhere(), {other, 0, 0});
  EXPECT_NEAR(both(0, 0), 1 + 0.5 * 400, 1e-9);
  EXPECT_NEAR(both(0, 3), 0.5 * 200, 1e-9);
  EXPECT_NEAR(both(1, 1), 1, 1e-9);
  EXPECT_TRUE(with_other_minimum(local, somewhere(), {other, 60, 0}).isApprox(local, 1e-9));
}

OtherEnd end_with(double worse, double error, bool unsolved = false) {
  return {somewhere(), worse, error, unsolved};
}

TEST(OtherMinimum, IsTheLeastWorseThatCompetes) {
  EXPECT_FALSE(competing_minimum({}));
  EXPECT_FALSE(competing_minimum(std::vector{end_with(4.1, 1), end_with(30, 2)}));
  const auto other = competing_minimum(std::vector{end_with(3.9, 1), end_with(2, 0.1), end_with(2.5, 3)});
  ASSERT_TRUE(other);
  EXPECT_EQ(other->delta_neg_llh, 2);
  EXPECT_EQ(other->delta_neg_llh_error, 0.1);
  EXPECT_EQ(competing_minimum(std::vector{end_with(-1, 0.5)})->delta_neg_llh, 0);
}

// Half a chi-square of seven has mean 3.5 and variance 3.5.
TEST(OtherMinimum, CountsUnsolvedEndsAsAtTheirMinimum) {
  const auto other = competing_minimum(std::vector{end_with(6, 0, true)});
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->delta_neg_llh, 2.5, 1e-12);
  EXPECT_NEAR(other->delta_neg_llh_error, std::sqrt(3.5), 1e-12);
  EXPECT_FALSE(competing_minimum(std::vector{end_with(10, 0, true)}));
}

}  // namespace
}  // namespace floe

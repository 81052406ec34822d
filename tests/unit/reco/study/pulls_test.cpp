#include "reco/study/pulls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floe {
namespace {

// With plain quantiles it would be 0.86.
TEST(Pulls, CoreOfTenGaussianPullsIsOneOnAverage) {
  constexpr int studies = 4000;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  double sum = 0;
  for (int study = 0; study < studies; ++study) {
    std::vector<double> pulls(10);
    for (double& pull : pulls) pull = normal(engine);
    sum += summary_of(pulls).core / studies;
  }
  // Each is known to 0.96 / sqrt(10); the rest is what Blom's positions leave.
  EXPECT_NEAR(sum, 1, 4 * 0.96 / std::sqrt(10.0 * studies) + 0.02);
}

TEST(Pulls, CoreIsLeftOpenForFewValues) {
  const std::vector<double> pulls{0.1, -0.4, 1.2, 0.3, -2};
  EXPECT_TRUE(std::isnan(summary_of(pulls).core));
  EXPECT_GT(summary_of(pulls).width, 0);
}

// Events whose seven pulls are one and the same tell as much as one pull each; independent ones seven times
// as much.
TEST(Pulls, ErrorsOfPooledPullsKnowThatThoseOfAnEventBelongTogether) {
  constexpr int events = 400;
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  std::vector<Vector7> alike, independent;
  for (int i = 0; i < events; ++i) {
    alike.push_back(Vector7::Constant(normal(engine)));
    Vector7 free;
    for (double& pull : free) pull = normal(engine);
    independent.push_back(free);
  }
  const auto expect_errors_of = [](const PullSummary& found, double values) {
    // Bootstrap errors of 400 events scatter by some per cent, those of the core by more.
    EXPECT_NEAR(found.width_error, 1 / std::sqrt(2 * values), 0.15 / std::sqrt(2 * values));
    EXPECT_NEAR(found.core_error, 0.96 / std::sqrt(values), 0.3 * 0.96 / std::sqrt(values));
    EXPECT_NEAR(found.coverage_error, binomial_error(values), 0.1 * binomial_error(values));
  };
  expect_errors_of(summary_of(alike), events);
  expect_errors_of(summary_of(independent), 7 * events);
}

TEST(Pulls, CoverageOfAFewThatAreAllInsideIsNotExact) {
  const std::vector<Vector7> inside(2, Vector7::Zero());
  EXPECT_EQ(summary_of(inside).coverage, 1);
  EXPECT_DOUBLE_EQ(summary_of(inside).coverage_error, binomial_error(14));
}

}  // namespace
}  // namespace floe

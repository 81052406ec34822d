// The tests that judge the engine are judged themselves: on samples that agree and on samples that do not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reco/validation/sample_comparison.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {
namespace {

TEST(ChiSquareProbability, MatchesTables) {
  EXPECT_NEAR(chi_square_probability(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_probability(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_probability(149.449253, 100), 0.001, 1e-7);
  EXPECT_DOUBLE_EQ(chi_square_probability(0, 5), 1);
}

std::vector<double> gaussian(std::mt19937_64& random, int count, double mean) {
  std::normal_distribution<double> normal(mean, 1);
  std::vector<double> values(static_cast<std::size_t>(count));
  for (double& value : values) value = normal(random);
  return values;
}

TEST(KolmogorovSmirnov, IsUniformWhenTheSamplesAgree) {
  std::mt19937_64 random(1);
  constexpr int trials = 2000;
  int below_tenth = 0, below_half = 0;
  for (int i = 0; i < trials; ++i) {
    const double p = kolmogorov_smirnov(gaussian(random, 250, 0), gaussian(random, 400, 0)).probability;
    below_tenth += p < 0.1;
    below_half += p < 0.5;
  }
  // Binomial errors, and the asymptotic formula's own few percent.
  EXPECT_NEAR(below_tenth, 0.1 * trials, 4 * std::sqrt(0.09 * trials) + 0.01 * trials);
  EXPECT_NEAR(below_half, 0.5 * trials, 4 * std::sqrt(0.25 * trials) + 0.03 * trials);
}

TEST(KolmogorovSmirnov, SeesAShiftAndCountsTies) {
  std::mt19937_64 random(2);
  EXPECT_LT(kolmogorov_smirnov(gaussian(random, 1000, 0), gaussian(random, 1000, 0.3)).probability, 1e-4);
  const auto equal = kolmogorov_smirnov({1, 1, 2, 3}, {1, 1, 2, 3});
  EXPECT_EQ(equal.distance, 0);
  EXPECT_EQ(equal.probability, 1);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov({0, 0, 0}, {1, 1}).distance, 1);
}

// Poisson counts on 40 modules, times exponential with the module's own scale, directions isotropic.
std::vector<Hit> toy_hits(std::uint64_t seed, double scale, double brighter, double later, double tilted) {
  std::mt19937_64 random(seed);
  std::vector<Hit> hits;
  for (int dom = 1; dom <= 40; ++dom) {
    const double mean = 30 + 12 * dom;
    const int count = std::poisson_distribution<int>(scale * mean * (dom == 7 ? brighter : 1))(random);
    for (int i = 0; i < count; ++i) {
      Hit hit;
      hit.module = {1, dom};
      hit.time = std::exponential_distribution<double>(1.0 / (100 + dom + (dom == 30 ? later : 0)))(random);
      const double z = std::uniform_real_distribution<double>(-1, 1 + (dom == 30 ? tilted : 0))(random);
      hit.direction = unit_vector(std::acos(std::min(z, 1.0)), 0).cast<float>();
      hit.inward = hit.direction;
      hits.push_back(hit);
    }
  }
  return hits;
}

constexpr double level = 0.001;

TEST(CompareSamples, PassesSamplesOfOneSource) {
  int failures = 0;
  constexpr int trials = 30;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const auto c = compare_samples(toy_hits(seed, 0.6, 1, 0, 0), 0.6, toy_hits(seed + 100, 1, 1, 0, 0), 1, 1);
    EXPECT_NEAR(c.ratio, 1, 4 * c.ratio_error);
    failures += c.chi_square_p < 0.1;
    EXPECT_TRUE(c.times.passes(level) && c.zeniths.passes(level) && c.impacts.passes(level));
    EXPECT_GE(c.modules, 38);  // the dimmest expects 25 hits and may fall below 20
  }
  EXPECT_NEAR(failures, 0.1 * trials, 4 * std::sqrt(0.09 * trials));
}

TEST(CompareSamples, SeesOneBrightModule) {
  const auto c = compare_samples(toy_hits(1, 1, 3.0, 0, 0), 1, toy_hits(2, 1, 1, 0, 0), 1, 1);
  EXPECT_LT(c.chi_square_p, level);
}

TEST(CompareSamples, SeesLateLightAndNamesTheModule) {
  const auto c = compare_samples(toy_hits(1, 1, 1, 120, 0), 1, toy_hits(2, 1, 1, 0, 0), 1, 1);
  EXPECT_FALSE(c.times.passes(level));
  EXPECT_EQ(c.times.worst, (ModuleId{1, 30}));
}

TEST(CompareSamples, SeesOtherDirections) {
  const auto c = compare_samples(toy_hits(1, 1, 1, 0, 1.5), 1, toy_hits(2, 1, 1, 0, 0), 1, 1);
  EXPECT_FALSE(c.zeniths.passes(level));
}

TEST(CompareSamples, AllowsForOverDispersion) {
  const auto a = toy_hits(1, 1, 1.3, 0, 0), b = toy_hits(2, 1, 1, 0, 0);
  EXPECT_NEAR(compare_samples(a, 1, b, 1, 2).chi_square, compare_samples(a, 1, b, 1, 1).chi_square / 2, 1e-9);
}

}  // namespace
}  // namespace floe

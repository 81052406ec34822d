#include "reco/likelihood/bayesian_blocks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace floe {
namespace {

double fitness(const std::vector<double>& counts, const std::vector<std::size_t>& cuts, double prior) {
  double sum = 0;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= cuts.size(); ++k) {
    const std::size_t end = k < cuts.size() ? cuts[k] : counts.size();
    double n = 0;
    for (std::size_t i = begin; i < end; ++i) n += counts[i];
    if (n > 0) sum += n * std::log(n / double(end - begin));
    sum -= prior;
    begin = end;
  }
  return sum;
}

TEST(BayesianBlocks, IsTheBestOfAllPartitions) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<double> counts(11);
    for (std::size_t i = 0; i < counts.size(); ++i)
      counts[i] = std::poisson_distribution<int>(i < 4 ? 0.2 : i < 7 ? 15 : 2)(random);
    const double prior = 4 - std::log(73.53 * 0.05 * std::pow(11.0, -0.478));
    double best = -std::numeric_limits<double>::infinity();
    for (unsigned mask = 0; mask < (1u << 10); ++mask) {
      std::vector<std::size_t> cuts;
      for (std::size_t i = 0; i < 10; ++i)
        if (mask >> i & 1) cuts.push_back(i + 1);
      best = std::max(best, fitness(counts, cuts, prior));
    }
    EXPECT_NEAR(fitness(counts, bayesian_blocks(counts), prior), best, 1e-9);
  }
}

TEST(BayesianBlocks, FindsAStepWhereItIs) {
  std::vector<double> counts(60, 0);
  for (std::size_t i = 20; i < 30; ++i) counts[i] = 50;
  EXPECT_EQ(bayesian_blocks(counts), (std::vector<std::size_t>{20, 30}));
}

TEST(BayesianBlocks, LeavesConstantLightWhole) {
  // p = 0.05 is the chance of one false cut; 100 trials give more than 15 with a chance below 1e-4.
  std::mt19937 random(5);
  int cut = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> counts(100);
    for (double& count : counts) count = std::poisson_distribution<int>(4)(random);
    cut += !bayesian_blocks(counts).empty();
  }
  EXPECT_LE(cut, 15);
}

TEST(BayesianBlocks, OneHitIsOneBin) {
  EXPECT_TRUE(bayesian_blocks(std::vector<double>{0, 1, 0, 0}).empty());
  EXPECT_TRUE(bayesian_blocks(std::vector<double>{}).empty());
}

TEST(BayesianBlocks, EdgesLieOnTheGridAndCoverHits) {
  std::vector<double> times, charges;
  for (int i = 0; i < 400; ++i) times.push_back(1000 + 0.25 * i), charges.push_back(1);
  const auto edges = block_edges(times, charges, 500, 3000);
  ASSERT_GE(edges.size(), 2u);
  for (const double edge : edges) EXPECT_EQ(std::remainder(edge, 25), 0);
  EXPECT_EQ(edges.front(), 1000);
  EXPECT_EQ(edges.back(), 1100);
}

TEST(BayesianBlocks, TenThousandHitsAreFast) {
  std::mt19937 random(1);
  std::vector<double> times(10000), charges(10000, 1);
  for (double& time : times) time = std::exponential_distribution<double>(1 / 600.0)(random);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GT(block_edges(times, charges, -200, 6000).size(), 3u);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.5);
}

}  // namespace
}  // namespace floe

// Which of two expectations data come from, by simulations that are hardly larger than they.
#include "reco/direct_fit/two_cascades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reco/direct_fit/other_minimum.h"

namespace floe {
namespace {

constexpr std::size_t bins = 300;
constexpr int parts = 4;

constexpr double clear = 1, slight = 0.25;

// The same in most bins; in some up to 40% more or 30% less, times `strength`.
std::vector<double> expectation(double strength) {
  std::vector<double> result(bins);
  for (std::size_t i = 0; i < bins; ++i) {
    result[i] = 4.0 + double(i % 37);
    if (i % 10 == 0) result[i] *= 1 + strength * (i % 20 == 0 ? 0.4 : -0.3);
  }
  return result;
}

class Toys {
 public:
  // Simulations of all parts together are so many times as large as the data.
  explicit Toys(unsigned seed, double simulated = 5) : random_(seed), simulated_(simulated) {}
  std::vector<double> data(const std::vector<double>& mean) {
    std::vector<double> counts;
    for (const double m : mean) counts.push_back(draw(m));
    return counts;
  }
  Evaluation simulate(const std::vector<double>& mean, const std::vector<double>& data) {
    Evaluation result;
    for (int k = 0; k < parts; ++k) {
      std::vector<BinOfData>& part = result.parts.emplace_back();
      for (std::size_t i = 0; i < bins; ++i)
        part.push_back({{data[i], 1, draw(mean[i] * simulated_ / parts), simulated_ / parts}});
    }
    const auto sum_without = [&](int left_out) {
      std::vector<BinOfData> sum(bins);
      for (std::size_t i = 0; i < bins; ++i) {
        sum[i].data = data[i], sum[i].simulation_events = 0;
        for (int k = 0; k < parts; ++k)
          if (k != left_out) {
            sum[i].simulation += result.parts[std::size_t(k)][i].simulation;
            sum[i].simulation_events += result.parts[std::size_t(k)][i].simulation_events;
          }
      }
      return sum;
    };
    result.bins = sum_without(-1);
    result.neg_llh = neg_llh(result.bins, 0);
    for (int k = 0; k < parts; ++k) result.leave_one_out.push_back(neg_llh(sum_without(k), 0));
    return result;
  }

 private:
  std::mt19937_64 random_;
  double simulated_;
  double draw(double mean) { return double(std::poisson_distribution<long>(mean)(random_)); }
};

struct Outcome {
  int right = 0, right_by_likelihoods = 0, clear = 0, clear_by_likelihoods = 0;
};
Outcome tell_toys_apart(int toys, bool true_is_other) {
  const std::vector<double> one = expectation(0), other = expectation(clear);
  Toys draws(1);
  Outcome outcome;
  for (int i = 0; i < toys; ++i) {
    const std::vector<double> data = draws.data(true_is_other ? other : one);
    const Evaluation a = draws.simulate(one, data), b = draws.simulate(other, data);
    const double sign = true_is_other ? 1 : -1;
    const Difference by_sum = worse_by(a, b, 0, 1), by_likelihoods = difference(a, b);
    outcome.right += sign * by_sum.value > 0;
    outcome.right_by_likelihoods += sign * by_likelihoods.value > 0;
    outcome.clear += sign * by_sum.value > 2 * by_sum.error;
    outcome.clear_by_likelihoods += sign * by_likelihoods.value > 2 * by_likelihoods.error;
  }
  return outcome;
}

// The sum is right as often as the likelihoods are, and knows it more often.
TEST(TwoCascades, AreToldApartMoreClearlyThanByTheirLikelihoods) {
  for (const bool true_is_other : {false, true}) {
    const Outcome outcome = tell_toys_apart(200, true_is_other);
    EXPECT_GE(outcome.right, 190);
    EXPECT_GT(outcome.clear, outcome.clear_by_likelihoods + 10);
  }
}

// Data of neither: with the same expectation for both the sum must prefer none, nor claim to know.
TEST(TwoCascades, OfTheSameLightAreNot) {
  const std::vector<double> mean = expectation(0);
  Toys draws(2);
  constexpr int toys = 400;
  double sum = 0, square = 0;
  for (int i = 0; i < toys; ++i) {
    const std::vector<double> data = draws.data(mean);
    const Evaluation a = draws.simulate(mean, data), b = draws.simulate(mean, data);
    const double value = worse_by(a, b, 0, 1).value;
    EXPECT_NEAR(value, -worse_by(b, a, 0, 1).value, 1e-9);
    sum += value, square += value * value;
  }
  const double spread = std::sqrt(square / toys);
  EXPECT_LT(std::abs(sum / toys), 3 * spread / std::sqrt(toys));
  EXPECT_LT(spread, 1.5);
}

// A difference that data and simulations hardly show: how often the wrong one is preferred is what the odds
// say.
TEST(TwoCascades, HaveTheOddsThatTheyClaim) {
  const std::vector<double> one = expectation(0), other = expectation(slight);
  Toys draws(3, 20);
  constexpr int toys = 1000;
  double wrong = 0, claimed = 0;
  for (int i = 0; i < toys; ++i) {
    const bool other_is_true = i % 2 == 1;
    const std::vector<double> data = draws.data(other_is_true ? other : one);
    const Difference worse = worse_by(draws.simulate(one, data), draws.simulate(other, data), 0, 1);
    wrong += (worse.value > 0) != other_is_true;
    claimed += share_of({{}, std::abs(worse.value), worse.error});
  }
  EXPECT_GT(wrong, 0.05 * toys);
  EXPECT_NEAR(wrong / toys, claimed / toys, 3 * std::sqrt(claimed) / toys);
}

TEST(TwoCascades, WithoutLightAreNotToldApart) {
  Toys draws(4);
  const std::vector<double> nothing(bins, 0.0);
  const Evaluation empty = draws.simulate(nothing, nothing);
  const Difference worse = worse_by(empty, empty, 0, 1);
  EXPECT_EQ(worse.value, 0);
  EXPECT_EQ(worse.error, 0);
}

}  // namespace
}  // namespace floe

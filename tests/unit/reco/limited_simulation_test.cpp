#include "reco/likelihood/limited_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floe {
namespace {

// The expression of arXiv:1304.0735 as it stands, for given rates.
double full_expression(const BinCounts& c, double mu_d, double mu_s, double sigma) {
  const auto side = [](double count, double events, double mu) {
    return (count > 0 ? count * std::log(count / events / mu) : 0) + events * mu - count;
  };
  const double gap = std::log(mu_d / mu_s);
  return side(c.data, c.data_events, mu_d) + side(c.simulation, c.simulation_events, mu_s) +
         gap * gap / (2 * sigma * sigma);
}

// Its minimum by nested golden-section search over ln mu_s and ln mu_d.
template <class F>
double golden(F f, double low, double high) {
  const double g = 0.5 * (std::sqrt(5.0) - 1);
  double a = high - g * (high - low), b = low + g * (high - low), fa = f(a), fb = f(b);
  for (int i = 0; i < 90; ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa, a = high - g * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + g * (high - low), fb = f(b);
    }
  }
  return std::min(fa, fb);
}
double brute_force(const BinCounts& c, double sigma) {
  return golden(
      [&](double ln_s) {
        return golden([&](double ln_d) { return full_expression(c, std::exp(ln_d), std::exp(ln_s), sigma); },
                      -25, 15);
      },
      -25, 15);
}

const BinCounts cases[] = {{10, 1, 12, 1},    {3, 1, 40, 10},   {0, 1, 5, 2},      {7, 1, 0, 3},
                           {1000, 1, 900, 1}, {1, 1, 1e5, 2e4}, {5, 2, 5, 2},      {250, 1, 30, 0.2},
                           {0, 1, 1e4, 10},   {4000, 1, 0, 1},  {0.25, 1, 2.5, 4}, {12, 1, 1, 0.001}};

TEST(LimitedSimulation, AgreesWithBruteForceMinimisation) {
  for (const BinCounts& c : cases)
    for (const double sigma : {0.05, 0.1, 0.5, 2.0}) {
      const double expected = brute_force(c, sigma);
      EXPECT_NEAR(limited_simulation(c, sigma).value, expected, 1e-6 * (1 + expected))
          << c.data << " " << c.simulation << " sigma " << sigma;
    }
}

TEST(LimitedSimulation, RatesAreWhereTheExpressionIsSmallest) {
  for (const BinCounts& c : cases) {
    const BinLikelihood bin = limited_simulation(c, 0.1);
    EXPECT_NEAR(full_expression(c, bin.data_rate, bin.simulation_rate, 0.1), bin.value,
                1e-8 * (1 + bin.value));
  }
}

TEST(LimitedSimulation, IsZeroForAPerfectMatch) {
  for (const double d : {0.0, 1.0, 7.0, 1e5}) {
    const BinLikelihood bin = limited_simulation({d, 1, 3 * d, 3}, 0.1);
    EXPECT_NEAR(bin.value, 0, 1e-12);
    EXPECT_NEAR(bin.slope, 0, 1e-9);
  }
}

TEST(LimitedSimulation, TreatsDataAndSimulationAlike) {
  for (const BinCounts& c : cases)
    for (const double sigma : {0.0, 0.1, 1.0}) {
      const BinCounts swapped{c.simulation, c.simulation_events, c.data, c.data_events};
      EXPECT_NEAR(limited_simulation(c, sigma).value, limited_simulation(swapped, sigma).value, 1e-9);
    }
}

TEST(LimitedSimulation, WithoutModelErrorHasOneCommonRate) {
  for (const BinCounts& c : cases) {
    const double rate = (c.data + c.simulation) / (c.data_events + c.simulation_events);
    const BinLikelihood exact = limited_simulation(c, 0);
    EXPECT_NEAR(exact.data_rate, rate, 1e-12 * rate);
    EXPECT_NEAR(exact.simulation_rate, rate, 1e-9 * rate);
    EXPECT_NEAR(limited_simulation(c, 1e-5).value, exact.value, 1e-4 * (1e-3 + exact.value));
  }
}

TEST(LimitedSimulation, WithEndlessSimulationIsPoisson) {
  const double d = 14, mean = 9.5;
  EXPECT_NEAR(limited_simulation({d, 1, mean * 1e12, 1e12}, 0).value, d * std::log(d / mean) + mean - d,
              1e-6);
  EXPECT_NEAR(limited_simulation({0, 1, mean * 1e12, 1e12}, 0).value, mean, 1e-6);
}

// For many counts -ln L is half of chi-square with the variances of both counts and the model's; the
// next order is smaller by the relative difference of the two rates.
TEST(LimitedSimulation, WithManyCountsIsHalfOfChiSquare) {
  const double d = 1.01e6, s = 1e6, sigma = 0.003;
  const double gap = std::log(d / s);
  const double chi2 = gap * gap / (1 / d + 1 / s + sigma * sigma);
  EXPECT_NEAR(limited_simulation({d, 1, s, 1}, sigma).value, 0.5 * chi2, 0.01 * chi2);
}

TEST(LimitedSimulation, SlopeAndCurvatureAreTheDerivatives) {
  for (const BinCounts& c : cases)
    for (const double sigma : {0.0, 0.1, 0.7}) {
      if (c.simulation == 0) continue;
      const auto moved = [&](double log_change) {
        BinCounts b = c;
        b.simulation_events *= std::exp(-log_change);
        return limited_simulation(b, sigma);
      };
      const double h = 1e-4;
      const BinLikelihood here = moved(0);
      EXPECT_NEAR((moved(h).value - moved(-h).value) / (2 * h), here.slope,
                  1e-5 * (1 + std::abs(here.slope)));
      EXPECT_NEAR((moved(h).slope - moved(-h).slope) / (2 * h), here.curvature, 1e-5 * (1 + here.curvature));
      EXPECT_GE(here.curvature, 0);
    }
}

TEST(LimitedSimulation, LittleSimulationForgivesMore) {
  const double little = limited_simulation({100, 1, 5, 0.1}, 0.1).value;
  const double much = limited_simulation({100, 1, 5000, 100}, 0.1).value;
  EXPECT_LT(little, much);
}

}  // namespace
}  // namespace floe

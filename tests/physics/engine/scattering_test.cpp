// Scattering angles against the moments and the density of their distributions.
#include "propagation/engine/scattering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "data/base/constants.h"
#include "data/base/vec3.h"
#include "propagation/engine/directions.h"
#include "propagation/engine/random.h"
#include "propagation/engine/vector_math.h"

namespace floe {
namespace {

constexpr int directions = 400000;

// <cos>, <cos^2> of Henyey-Greenstein and of simplified Liu (integrals of their definitions).
struct Moments {
  double first, second;
};
Moments henyey_greenstein(double g) {
  return {g, (1 + 2 * g * g) / 3};
}
Moments simplified_liu(double g) {
  const double e = (1 - g) / (1 + g);
  return {g, 4 / (1 + 2 * e) - 4 / (1 + e) + 1};
}

class Scattering : public ::testing::TestWithParam<std::pair<float, float>> {};

TEST_P(Scattering, HasTheMomentsOfItsDistribution) {
  const auto [liu_fraction, g] = GetParam();
  const ScatteringFunction<float> function{liu_fraction, g};
  double first = 0, second = 0, fourth = 0;
  RandomStream random(3, 0, 0);
  for (int i = 0; i < directions; ++i) {
    const double cosine = 1 - function.one_minus_cos(random.uniform());
    first += cosine / directions;
    second += cosine * cosine / directions;
    fourth += std::pow(cosine, 4) / directions;
  }
  const Moments liu = simplified_liu(g), hg = henyey_greenstein(g);
  const double expected_second = liu_fraction * liu.second + (1 - liu_fraction) * hg.second;
  EXPECT_NEAR(first, g, 4 * std::sqrt((second - first * first) / directions));
  EXPECT_NEAR(second, expected_second, 4 * std::sqrt((fourth - second * second) / directions));
}

INSTANTIATE_TEST_SUITE_P(Functions, Scattering,
                         ::testing::Values(std::pair(0.0f, 0.9f), std::pair(1.0f, 0.9f),
                                           std::pair(0.35f, 0.9f), std::pair(0.137f, 0.94f),
                                           std::pair(0.5f, 0.3f), std::pair(0.0f, 0.0f)));

// The density, integrated over bins of the angle, against draws.
TEST_P(Scattering, FollowsItsDensity) {
  const auto [liu_fraction, g] = GetParam();
  const ScatteringFunction<float> function{liu_fraction, g};
  const ScatteringFunction<double> exact{liu_fraction, g};
  constexpr int bins = 50, steps = 400;
  std::vector<double> counts(bins), expected(bins);
  RandomStream random(4, 0, 0);
  for (int i = 0; i < directions; ++i) {
    const double half_angle = std::asin(std::sqrt(function.one_minus_cos(random.uniform()) / 2));
    ++counts[static_cast<std::size_t>(std::min(bins - 1.0, half_angle / (pi / 2) * bins))];
  }
  double sum = 0, chi_square = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (int step = 0; step < steps; ++step) {
      const double angle = pi * (static_cast<double>(bin) + (step + 0.5) / steps) / bins;
      expected[bin] +=
          directions * exact.density(1 - std::cos(angle)) * std::sin(angle) * pi / (bins * steps);
    }
    sum += expected[bin];
    chi_square += std::pow(counts[bin] - expected[bin], 2) / std::max(1.0, expected[bin]);
  }
  EXPECT_NEAR(sum / directions, 1, 1e-4);
  EXPECT_LT(chi_square, bins + 5 * std::sqrt(2.0 * bins));
}

TEST(Deflect, KeepsTheAngleAndSpreadsEvenlyAround) {
  RandomStream random(5, 0, 0);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), unit_vector(2.1, -1.3)}) {
    Vec3 sum = Vec3::Zero();
    constexpr int turns = 10000;
    const double loss = 0.25;
    for (int i = 0; i < turns; ++i) {
      const Vec3 n = deflect(axis, loss, static_cast<double>(random.uniform()));
      ASSERT_NEAR(n.norm(), 1, 1e-12);
      ASSERT_NEAR(n.dot(axis), 1 - loss, 1e-12);
      sum += n / turns;
    }
    // Across the axis the mean is 0 within its error, sin^2/2 per component.
    EXPECT_NEAR((sum - (1 - loss) * axis).norm(), 0, 5 * std::sqrt((1 - 0.75 * 0.75) / turns));
  }
}

TEST(TurnFunctions, AreSineAndCosine) {
  for (int i = 0; i <= 100000; ++i) {
    const float u = static_cast<float>(i) / 100000;
    const TurnFunctions<float> turn = turn_functions(u);
    ASSERT_NEAR(turn.sine, std::sin(2 * pi * static_cast<double>(u)), 3e-7) << u;
    ASSERT_NEAR(turn.cosine, std::cos(2 * pi * static_cast<double>(u)), 3e-7) << u;
  }
}

}  // namespace
}  // namespace floe

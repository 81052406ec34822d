// Functions in vector form against the library's, over all the numbers that they promise to serve.
#include "propagation/engine/vector_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "propagation/engine/random.h"
#include "propagation/engine/scattering.h"

namespace floe {
namespace {

double relative_error(double found, double expected) {
  return expected == 0 ? std::fabs(found) : std::fabs(found / expected - 1);
}

// Every float of [1/4, 4), where the result is small and digits are lost, and one of 1999 elsewhere.
TEST(VectorMath, LogarithmIsExactToTwoInTenMillion) {
  constexpr auto first = std::bit_cast<std::int32_t>(std::numeric_limits<float>::min());
  constexpr auto last = std::bit_cast<std::int32_t>(std::numeric_limits<float>::max());
  constexpr auto dense_from = std::bit_cast<std::int32_t>(0.25F),
                 dense_to = std::bit_cast<std::int32_t>(4.0F);
  double worst = 0;
  float where = 0;
  for (std::int64_t bits = first; bits <= last; bits += bits >= dense_from && bits < dense_to ? 1 : 1999) {
    const auto x = std::bit_cast<float>(static_cast<std::int32_t>(bits));
    const double error = relative_error(natural_log(x), std::log(double{x}));
    if (error > worst) worst = error, where = x;
  }
  EXPECT_LT(worst, 2e-7) << "at " << where;
  EXPECT_EQ(natural_log(1.0F), 0.0F);
  EXPECT_LT(relative_error(natural_log(std::numeric_limits<float>::min()), -126 * std::log(2.0)), 2e-7);
}

// What exponential depths are drawn from: every uniform number that a stream can give.
TEST(VectorMath, LogarithmOfEveryUniformNumber) {
  double worst = 0, sum = 0;
  for (std::uint32_t k = 0; k < 1U << 23; ++k) {
    const float u = RandomStream::to_uniform(k << 9), depth = -natural_log(u);
    ASSERT_GT(depth, 0) << u;
    worst = std::max(worst, relative_error(-depth, std::log(double{u})));
    sum += depth;
  }
  EXPECT_LT(worst, 2e-7);
  EXPECT_NEAR(sum / (1U << 23), 1, 1e-6);  // the mean of an exponential distribution
}

// One of 19 of all floats from -80 to 0, and the ends.
TEST(VectorMath, DecayIsAsExactAsItsArgument) {
  constexpr auto last = std::bit_cast<std::int32_t>(80.0F);
  double worst = 0;  // in units of what may be
  float where = 0;
  const auto compare = [&](float x) {
    const double error = relative_error(decay(x), std::exp(double{x})) / (2e-7 + 8e-8 * std::fabs(x));
    if (error > worst) worst = error, where = x;
  };
  for (std::int32_t bits = 0; bits <= last; bits += 19) compare(-std::bit_cast<float>(bits));
  compare(-80);
  EXPECT_LT(worst, 1) << "at " << where;
  EXPECT_EQ(decay(0.0F), 1.0F);
  EXPECT_EQ(decay(-0.0F), 1.0F);
}

TEST(VectorMath, SineAndCosineOfEveryUniformNumber) {
  double worst = 0;
  const auto compare = [&](float u) {
    const TurnFunctions<float> found = turn_functions(u);
    const TurnFunctions<double> expected = turn_functions(double{u});
    worst =
        std::max({worst, std::fabs(found.sine - expected.sine), std::fabs(found.cosine - expected.cosine)});
  };
  for (std::uint32_t k = 0; k < 1U << 23; ++k) compare(RandomStream::to_uniform(k << 9));
  for (const float u : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) compare(u);
  EXPECT_LT(worst, 2.5e-7);
}

// The function of the lanes against the plain walk's. Where u is a share of a function of its own, the
// rounding of u itself, 6e-8, is what single precision adds: the slope of the angle times that.
TEST(ScatteringFunction, InSinglePrecisionIsThatInDouble) {
  for (const float liu : {0.0F, 0.35F, 0.5F, 1.0F})
    for (const float g : {-0.5F, 0.0F, 0.3F, 0.9F, 0.95F}) {
      const ScatteringFunction<float> single{liu, g};
      const ScatteringFunction<double> exact{liu, g};
      double sum = 0;
      int count = 0;
      for (std::uint32_t k = 0; k < 1U << 23; k += 7) {
        const float u = RandomStream::to_uniform(k << 9);
        const double found = single.one_minus_cos(u), expected = exact.one_minus_cos(u);
        ASSERT_GE(found, 0);
        ASSERT_LE(found, 2);
        constexpr double step = 1.2e-7;
        const double low = std::max(u - step, 1e-9), high = std::min(u + step, 1 - 1e-9);
        // Around the border between both functions u may fall to either.
        if (low < liu && liu < high) continue;
        const double slope = std::fabs(exact.one_minus_cos(high) - exact.one_minus_cos(low));
        ASSERT_NEAR(found, expected, 1e-6 + slope) << "u " << u << ", g " << g << ", share of Liu " << liu;
        sum += found;
        ++count;
      }
      EXPECT_NEAR(1 - sum / count, g, 2e-5) << "share of Liu " << liu;  // by construction of both
    }
}

}  // namespace
}  // namespace floe

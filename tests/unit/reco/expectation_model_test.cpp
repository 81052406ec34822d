#include "reco/direct_fit/expectation_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace floe {
namespace {

LightRequest request() {
  LightRequest request;
  request.cascade = {{20, -40, -300}, 0, 1.2, 2.3, 1e4};
  request.photons = 1e5;
  request.oversize = 20;
  return request;
}

LightSample sample_with(std::vector<ExpectedDelay> delays) {
  SimulatedLight light(load_model({}), CascadeKind::electron, 5, 1, std::move(delays));
  return light.sample(request());
}

TEST(SimulatedLight, LatePulsesMoveTheirShareAndNothingElse) {
  const LightSample plain = sample_with({}),
                    late = sample_with({{0.2, 1e6, 1e6 + 100}, {0.1, 2e6, 2e6 + 50}});
  ASSERT_EQ(late.times.size(), plain.times.size());
  ASSERT_EQ(late.first, plain.first);
  const auto n = static_cast<double>(plain.times.size());
  ASSERT_GT(n, 500);
  double first = 0, second = 0;
  std::vector<float> on_time;
  for (const float time : late.times) {
    first += time > 0.9e6f && time < 1.1e6f;
    second += time > 1.9e6f;
    if (time < 0.9e6f) on_time.push_back(time);
  }
  EXPECT_NEAR(first, 0.2 * n, 5 * std::sqrt(0.2 * 0.8 * n));
  EXPECT_NEAR(second, 0.1 * n, 5 * std::sqrt(0.1 * 0.9 * n));
  // Who is not late is where it was.
  std::vector<float> before = plain.times;
  std::sort(before.begin(), before.end());
  for (const float time : on_time) EXPECT_TRUE(std::binary_search(before.begin(), before.end(), time));
}

// A neighbour simulated with the same random numbers has the same photons late: differences stay differences
// of light.
TEST(SimulatedLight, TheSameRequestHasTheSameLatePulses) {
  EXPECT_EQ(sample_with({{0.2, 50, 100}}).times, sample_with({{0.2, 50, 100}}).times);
}

}  // namespace
}  // namespace floe

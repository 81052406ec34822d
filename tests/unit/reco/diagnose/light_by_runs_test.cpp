// How much light simulations have, by how many there are.
#include "reco/diagnose/light_by_runs.h"

#include <gtest/gtest.h>

namespace floe::test {
namespace {

TEST(LightByRuns, IsTheSameInAllUpToWhatIsAsked) {
  EXPECT_DOUBLE_EQ(light_by_runs(6, 0.4, 1), 0.4);
  EXPECT_DOUBLE_EQ(light_by_runs(4, 0.4, 1), 0.6);
  EXPECT_DOUBLE_EQ(light_by_runs(2, 0.4, 1), 1);      // not 1.2
  EXPECT_DOUBLE_EQ(light_by_runs(100, 0.4, 1), 0.4);  // what each needs for itself
}

}  // namespace
}  // namespace floe::test

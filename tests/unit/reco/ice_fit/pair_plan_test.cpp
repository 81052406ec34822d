// How much light pairs of simulations get.
#include <gtest/gtest.h>

#include "reco/ice_fit/ice_point.h"

namespace floe {
namespace {

TEST(PairPlan, LightIsAShareOfTheRuns) {
  PairPlan plan;
  plan.light = 0.25;
  EXPECT_EQ(plan.share(2e4), 0.25);
  EXPECT_EQ(plan.share(0), 0.25);
}

TEST(PairPlan, DimRunsGetEnoughHitsButNotMoreThanTheRunHas) {
  PairPlan plan;
  plan.light = 0.25;
  plan.least_hits = 15000;
  EXPECT_EQ(plan.share(2e5), 0.25);
  EXPECT_EQ(plan.share(6e4), 0.25);
  EXPECT_EQ(plan.share(3e4), 0.5);
  EXPECT_EQ(plan.share(1e4), 1);
  EXPECT_EQ(plan.share(0), 1);
  plan.light = 2;  // asked for
  EXPECT_EQ(plan.share(1e4), 2);
}

}  // namespace
}  // namespace floe

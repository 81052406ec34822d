// Cascades of single hadrons against the formulas of arXiv:1210.5140.
#include <gtest/gtest.h>

#include <cmath>

#include "propagation/sources/cascade.h"

namespace floe {
namespace {

struct Expected {
  const char* name;
  double yield, spread, depth;  // at 100 GeV: F, sigma_F/F, and mean depth of the light [m]
};

// F = 1 - (100/E0)^-m (1 - f0), sigma_F/F = rms0 ln(100)^-gamma, depth = (a + c ln 100) 0.39652
// 0.910/0.9216/b'.
constexpr Expected expected[] = {
    {"hadron", 0.751370, 0.120927, 4.064829}, {"pi+", 0.751370, 0.120927, 4.064829},
    {"pi-", 0.751645, 0.119519, 4.098989},    {"K0L", 0.743060, 0.122809, 4.045413},
    {"p", 0.684312, 0.110180, 3.709779},      {"n", 0.685933, 0.110616, 3.828232},
    {"pbar", 0.684312, 0.101614, 3.890144},
};

TEST(Hadrons, HaveTheYieldAndDepthOfTheirKind) {
  for (const Expected& e : expected) {
    const CascadeKind kind = cascade_kind_of(e.name);
    const LightYield light = light_yield(kind, 100);
    EXPECT_NEAR(light.mean / light_yield(CascadeKind::electron, 100).mean, e.yield, 1e-5) << e.name;
    EXPECT_NEAR(light.spread / light.mean, e.spread, 1e-5) << e.name;
    const LongitudinalProfile profile = longitudinal_profile(kind, 100);
    EXPECT_NEAR(profile.shape * profile.scale, e.depth, 1e-5) << e.name;
  }
}

}  // namespace
}  // namespace floe

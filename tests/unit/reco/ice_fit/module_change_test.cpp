#include "reco/ice_fit/module_change.h"

#include <gtest/gtest.h>

#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

Model changed(void (*change)(Module&)) {
  std::vector<Module> modules = test::modules_at({{0, 0, 0}, {50, 0, 0}, {0, 50, 0}});
  change(modules[1]);
  return test::make_model(test::uniform_tables({25, 100}), std::move(modules));
}
Model unchanged() {
  return changed([](Module&) {});
}

TEST(ModuleChange, OfAClockIsATimeOfItsModule) {
  const auto change =
      ModuleChange::between(unchanged(), changed([](Module& module) { module.clock_offset = 7; }));
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->only_clocks);
  EXPECT_EQ(change->touched, (std::vector<char>{0, 1, 0}));
  EXPECT_EQ(change->moved, (std::vector<char>{0, 0, 0}));
  EXPECT_EQ(change->later, (std::vector<double>{0, 7, 0}));
}

TEST(ModuleChange, OfAPlaceMovesALikelyFlasher) {
  const auto change =
      ModuleChange::between(unchanged(), changed([](Module& module) { module.position.x() += 1; }));
  ASSERT_TRUE(change);
  EXPECT_FALSE(change->only_clocks);
  EXPECT_EQ(change->touched, (std::vector<char>{0, 1, 0}));
  EXPECT_EQ(change->moved, (std::vector<char>{0, 1, 0}));
}

TEST(ModuleChange, OfAnEfficiencyMovesNothing) {
  const auto change =
      ModuleChange::between(unchanged(), changed([](Module& module) { module.relative_efficiency = 1.2; }));
  ASSERT_TRUE(change);
  EXPECT_FALSE(change->only_clocks);
  EXPECT_EQ(change->touched, (std::vector<char>{0, 1, 0}));
  EXPECT_EQ(change->moved, (std::vector<char>{0, 0, 0}));
}

TEST(ModuleChange, IsNoneWhereTheIceIsOtherIce) {
  Model other = unchanged();
  const Model clearer = test::make_model(test::uniform_tables({25, 120}),
                                         test::modules_at({{0, 0, 0}, {50, 0, 0}, {0, 50, 0}}));
  EXPECT_FALSE(ModuleChange::between(other, clearer));
  other.noise_rate = 500;
  EXPECT_FALSE(ModuleChange::between(unchanged(), other));
}

}  // namespace
}  // namespace floe

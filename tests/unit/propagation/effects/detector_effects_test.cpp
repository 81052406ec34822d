// What the effects on modules and sources do.
#include <gtest/gtest.h>

#include "propagation/sources/flasher.h"
#include "tests/unit/propagation/effects/changed_parts.h"

namespace floe::test {
namespace {

const Module& module_of(const ModelParts& parts, int string, int dom) {
  return parts.detector.modules()[parts.detector.index_of({string, dom})];
}

TEST(AngularAcceptanceEffect, TiltsTheCurve) {
  const ModelParts model = built_in_parts();
  const auto& before = model.acceptance.angular;
  for (const double slope : {-0.8, 0.5, 1.0}) {
    const auto after =
        changed(model, {"angular-acceptance.slope=" + std::to_string(slope)}).acceptance.angular;
    double largest = 0;
    for (int k = -100; k <= 100; ++k) {
      const double cosine = k / 100.0;
      const Vec3 direction(std::sqrt(1 - cosine * cosine), 0, cosine);
      const auto value = [&](const AngularAcceptance& a) {
        return a.maximum() * a.probability(direction, Vec3::UnitX(), Vec3::UnitZ());
      };
      EXPECT_NEAR(value(after), value(before) * (1 + slope * cosine), 1e-6) << cosine;
      largest = std::max(largest, value(after));
    }
    EXPECT_NEAR(after.maximum(), largest, 1e-4);
  }
}

TEST(AngularAcceptanceEffect, NeedsAPolynomial) {
  ModelParts model = built_in_parts();
  model.acceptance.angular = AngularAcceptance::surface(0.3);
  expect_refused(model, {"angular-acceptance.slope=0.1"}, "place of impact");
}

TEST(ModuleEfficiencyEffect, IsThatOfOneModule) {
  const ModelParts model = built_in_parts();
  const ModelParts changed_one = changed(
      model, {"module-efficiency.string=80", "module-efficiency.dom=3", "module-efficiency.factor=0.5"});
  EXPECT_EQ(module_of(changed_one, 80, 3).relative_efficiency, 0.5 * 1.35);
  EXPECT_EQ(module_of(changed_one, 80, 4).relative_efficiency, 1.35);
  EXPECT_EQ(module_of(changed_one, 79, 3).relative_efficiency, 1.35);
  EXPECT_NE(changed_one.detector.hash(), model.detector.hash());
  EXPECT_EQ(ice_hash(changed_one.ice), ice_hash(model.ice));
}

TEST(StringEfficiencyEffect, IsThatOfItsModules) {
  const ModelParts model = built_in_parts();
  const ModelParts string = changed(model, {"string-efficiency.string=1", "string-efficiency.factor=1.2"});
  for (const Module& module : string.detector.modules())
    EXPECT_EQ(module.relative_efficiency, module.id.string == 1 ? 1.2 : module.id.string > 78 ? 1.35 : 1.0);
}

TEST(OverallEfficiencyEffect, IsCountedInTheHashOfTheIce) {
  const ModelParts model = small_parts(), more = changed(model, {"overall-efficiency.factor=2"});
  EXPECT_EQ(more.acceptance.overall_efficiency, 2 * model.acceptance.overall_efficiency);
  EXPECT_NE(ice_hash(more.ice), ice_hash(model.ice));
}

TEST(GeometryOffsetEffect, MovesAStringWithItsHole) {
  ModelParts model = built_in_parts();
  model.detector = Detector("drilled", model.detector.modules(), {{63, {100, 200}}});
  const ModelParts moved =
      changed(model, {"geometry-offset.string=63", "geometry-offset.x=1.5", "geometry-offset.z=-2"});
  const Vec3 offset(1.5, 0, -2);
  EXPECT_EQ(module_of(moved, 63, 20).position, module_of(model, 63, 20).position + offset);
  EXPECT_EQ(module_of(moved, 64, 20).position, module_of(model, 64, 20).position);
  EXPECT_EQ(moved.detector.strings().at(63), Eigen::Vector2d(101.5, 200));
  EXPECT_EQ(moved.detector.strings().at(64), model.detector.strings().at(64));
  EXPECT_EQ(moved.detector.name(), "drilled");
}

TEST(TimeOffsetEffect, SetsTheClocksOfAString) {
  const ModelParts model = built_in_parts(),
                   late = changed(model, {"time-offset.string=63", "time-offset.time=4"});
  EXPECT_EQ(module_of(late, 63, 20).clock_offset, 4);
  EXPECT_EQ(module_of(late, 64, 20).clock_offset, 0);
  EXPECT_EQ(late.sources, model.sources);
  EXPECT_NE(late.detector.hash(), model.detector.hash());
}

TEST(CableShadowEffect, ScalesCablesThatThereAre) {
  ModelParts model = small_parts();
  expect_refused(model, {"cable-shadow.radius=0.03"}, "where the cables are is not known");
  std::vector<Module> modules = model.detector.modules();
  modules[0].cable_azimuth = 1;
  model.detector = Detector("cabled", modules);
  EXPECT_EQ(find_effect("cable-shadow").parameters(model)[0].null_value, cable_radius);
  EXPECT_EQ(changed(model, {"cable-shadow.radius=0.03"}).acceptance.cable_radius, 0.03);
}

TEST(EffectsOnModules, NeedModulesThatThereAre) {
  const ModelParts model = small_parts();
  expect_refused(model, {"time-offset.string=85", "time-offset.time=1"}, "found string 85");
  expect_refused(model, {"module-efficiency.factor=2"}, "found no module");
  expect_refused(model, {"module-efficiency.string=86", "module-efficiency.factor=2"}, "found no module");
  expect_refused(model, {"module-efficiency.string=86", "module-efficiency.dom=3"}, "string 86, dom 3");
  expect_refused(model, {"string-efficiency.factor=2"}, "found no string");
  expect_refused(model, {"string-efficiency.string=85"}, "found string 85; expected one of the 1 strings");
  expect_refused(model, {"geometry-offset.x=2"}, "found no string");
  expect_refused(model, {"geometry-offset.string=1", "geometry-offset.x=2"}, "found string 1;");
}

TEST(FlasherEffects, AdjustTheSettings) {
  const ModelParts model = changed(built_in_parts(), {"flasher-profile.width=2", "time-offset.time=-7.5",
                                                      "flasher-brightness.factor=0.1"});
  FlasherSettings nominal;
  nominal.photons = 1e9;
  nominal.time = 5;
  nominal.azimuth = 1;
  const FlasherSettings settings = adjusted(nominal, model.sources);
  EXPECT_EQ(settings.photons, 1e8);
  EXPECT_EQ(settings.time, -2.5);
  EXPECT_EQ(settings.beam_width, 2 * nominal.beam_width);
  EXPECT_EQ(settings.azimuth, nominal.azimuth);
  const FlasherSettings same = adjusted(nominal, {});
  EXPECT_EQ(same.photons, nominal.photons);
  EXPECT_EQ(same.beam_width, nominal.beam_width);
}

}  // namespace
}  // namespace floe::test

// What the effects on the ice do to its numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "propagation/ice/tilt.h"
#include "tests/unit/propagation/effects/changed_parts.h"

namespace floe::test {
namespace {

IceModel ice_of(const ModelParts& parts) {
  return IceModel(parts.ice, parts.detector);
}

ModelParts without(ModelParts parts, std::string_view effect) {
  switch_off(parts.ice, effect);
  return parts;
}

TEST(BirefringenceEffect, ScalesTheStrengthOfEveryLayer) {
  const ModelParts model = built_in_parts();
  const ModelParts half = changed(model, {"birefringence.strength=0.5"});
  const IceModel before = ice_of(model), after = ice_of(half);
  for (std::size_t i = 0; i < before.layers().size(); ++i) {
    EXPECT_EQ(after.layers()[i].diffusion_strength, before.layers()[i].diffusion_strength / 2);
    EXPECT_EQ(after.layers()[i].deflection_strength, before.layers()[i].deflection_strength / 2);
  }
  EXPECT_NEAR(after.effective_scattering(50, 400) - before.effective_scattering(50, 400),
              before.layers()[50].diffusion_strength / 2 * before.birefringent_scattering(), 1e-12);
}

TEST(BirefringenceEffect, AtZeroIsIceWithoutBirefringence) {
  for (const ModelParts& model : {built_in_parts(), small_parts()})
    expect_equal(changed(model, {"birefringence.strength=0"}), without(model, "birefringence"));
}

TEST(BirefringenceEffect, BringsPublishedNumbersWhereThereAreNone) {
  const ModelParts model = built_in_parts(), none = without(model, "birefringence");
  EXPECT_EQ(find_effect("birefringence").parameters(none)[0].null_value, 0);
  expect_equal(changed(none, {"birefringence.strength=1"}), model);
  const ModelParts twice = changed(none, {"birefringence.strength=2"});
  EXPECT_EQ(twice.ice.layers[9].birefringence_strength, 2 * model.ice.layers[9].birefringence_strength);
}

TEST(AbsorptionAnisotropyEffect, KeepsTheMeanAndIsWeakerAlongTheFlow) {
  const auto K = ice_of(changed(built_in_parts(), {"absorption-anisotropy.k1=0.2"})).absorption_anisotropy();
  EXPECT_NEAR(K[0] / K[1], std::exp(0.3), 1e-12);
  EXPECT_EQ(K[1], K[2]);
  EXPECT_GT(K[0], 1);
  const auto& c = changed(built_in_parts(), {"absorption-anisotropy.k1=0"}).ice.configuration;
  EXPECT_EQ(c.absorption_anisotropy->k2, 0);
}

TEST(ScatteringAnisotropyEffect, IsThatOfAllLayers) {
  const IceModel ice = ice_of(changed(small_parts(), {"scattering-anisotropy.k1=0.1"}));
  for (const IceLayer& layer : ice.layers()) {
    EXPECT_EQ(layer.k1, 0.1);
    EXPECT_EQ(layer.k2, -0.05);
  }
}

// Models without any leave the scaling of the old anisotropy of absorption at 1, where it does nothing.
TEST(ScatteringAnisotropyEffect, DoesNotSwitchTheOldAnisotropyOfAbsorptionOn) {
  ModelParts model = built_in_parts();
  model.ice.configuration.old_absorption_scaling = 1;
  EXPECT_EQ(ice_of(model).old_absorption_scaling(), 0);
  EXPECT_EQ(ice_of(changed(model, {"scattering-anisotropy.k1=0.1"})).old_absorption_scaling(), 0);
  model.ice.layers[0].k1 = 0.02;
  EXPECT_EQ(ice_of(changed(model, {"scattering-anisotropy.k1=0.1"})).old_absorption_scaling(), 1);
}

TEST(FlowAzimuthEffect, TurnsTheFlow) {
  EXPECT_NEAR(ice_of(changed(built_in_parts(), {"flow-azimuth.azimuth=90"})).flow_azimuth(), pi / 2, 1e-12);
}

TEST(ScatteringFunctionEffect, LeavesTheEffectiveScattering) {
  const IceModel before = ice_of(built_in_parts());
  const IceModel after =
      ice_of(changed(built_in_parts(), {"scattering-function.g=0.95", "scattering-function.liu=0.5"}));
  EXPECT_EQ(after.mean_cosine(), 0.95);
  EXPECT_EQ(after.simplified_liu_fraction(), 0.5);
  EXPECT_EQ(after.effective_scattering(20, 430), before.effective_scattering(20, 430));
  EXPECT_NEAR(after.geometric_scattering(20, 430), 2 * before.geometric_scattering(20, 430), 1e-9);
}

TEST(HoleIceEffect, SetsTheColumn) {
  const auto hole = changed(built_in_parts(), {"hole-ice.radius=0.9", "hole-ice.scattering=0.2"})
                        .ice.configuration.hole_ice;
  EXPECT_EQ(hole.radius, 0.9);
  EXPECT_EQ(hole.effective_scattering_length, 0.2);
}

// Of every kind of table: since 2013, a concentration of dust before, and the whole absorption in version 20.
class DustEffects : public ::testing::TestWithParam<const char*> {
 protected:
  DustEffects() : model_(small_parts()) {
    const std::string kind = GetParam();
    if (kind == "before2013") {
      const double to_table = std::pow(400, model_.ice.wavelength.kappa);
      model_.ice.wavelength.D = 0.9 * to_table, model_.ice.wavelength.E = 0.002 * to_table;
    }
    if (kind == "version20") model_.ice.version = 20;
  }
  // a_dust(400), bottom layer first.
  static std::vector<double> dust(const ModelParts& parts) {
    std::vector<double> values;
    const IceModel ice = ice_of(parts);
    for (const IceLayer& layer : ice.layers()) values.push_back(layer.absorption_dust);
    return values;
  }
  ModelParts model_;
};

TEST_P(DustEffects, ScaleMultipliesDustAlone) {
  const ModelParts twice = changed(model_, {"absorption-scale.factor=2"});
  const auto before = dust(model_), after = dust(twice);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], 2 * before[i], 1e-14);
  const IceModel a = ice_of(model_), b = ice_of(twice);
  EXPECT_EQ(b.layers()[0].absorption_thermal, a.layers()[0].absorption_thermal);
  EXPECT_EQ(b.effective_scattering(0, 400), a.effective_scattering(0, 400));
}

TEST_P(DustEffects, ScaleGoesDownToATenth) {
  const auto before = dust(model_), after = dust(changed(model_, {"absorption-scale.factor=0.1"}));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i] / 10, 1e-14);
}

TEST_P(DustEffects, LayerMultipliesWhatItOverlaps) {
  // Layers of 10 m at 1300, 1310 and 1320 m; from 1303 to 1313 m are 2 m of the first and 8 m of the second.
  const auto before = dust(model_);
  const auto after = dust(changed(
      model_, {"absorption-layer.depth=1308", "absorption-layer.width=10", "absorption-layer.factor=3"}));
  EXPECT_EQ(after[0], before[0]);
  EXPECT_NEAR(after[1], before[1] * (1 + 0.8 * 2), 1e-14);
  EXPECT_NEAR(after[2], before[2] * (1 + 0.2 * 2), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Tables, DustEffects, ::testing::Values("since2013", "before2013", "version20"),
                         [](const auto& kind) { return kind.param; });

TEST(DustEffect, OfALayerNeedsATableThatDependsOnIt) {
  ModelParts model = small_parts();
  model.ice.wavelength.D = 0, model.ice.wavelength.E = 20;
  expect_refused(model, {"absorption-layer.factor=2"}, "use absorption-scale");
  EXPECT_EQ(*changed(model, {"absorption-scale.factor=2"}).ice.wavelength.E, 40);
}

TEST(ScatteringScaleEffect, MultipliesTheTable) {
  const ModelParts model = small_parts(), more = changed(model, {"scattering-scale.factor=1.5"});
  for (std::size_t i = 0; i < model.ice.layers.size(); ++i)
    EXPECT_NEAR(more.ice.layers[i].effective_scattering, 1.5 * model.ice.layers[i].effective_scattering,
                1e-15);
}

std::vector<double> scattering(const std::vector<std::string>& settings) {
  std::vector<double> values;
  for (const IceLayerRow& row : changed(built_in_parts(), settings).ice.layers)
    values.push_back(row.effective_scattering);
  return values;
}

TEST(ScatteringLayerEffect, MultipliesWholeLayersByItsFactor) {
  const auto before = scattering({"scattering-layer.factor=1"});
  const auto after =
      scattering({"scattering-layer.depth=2000", "scattering-layer.width=40", "scattering-layer.factor=0.1"});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double depth = 1105 + 10 * static_cast<double>(i);
    const double factor = std::abs(depth - 2000) < 20 ? 0.1 : 1;
    EXPECT_NEAR(after[i], factor * before[i], 1e-15) << depth;
  }
}

// A fit that moves the layer must see no steps.
TEST(ScatteringLayerEffect, IsContinuousInDepthAndWidth) {
  const double factor = 4, step = 1e-6, steepest = (factor - 1) / 10 * step;
  const auto of = [&](double depth, double width) {
    return scattering({"scattering-layer.factor=4", "scattering-layer.depth=" + std::to_string(depth),
                       "scattering-layer.width=" + std::to_string(width)});
  };
  const auto whole = scattering({"scattering-layer.factor=1"});
  for (const double depth : {1994.0, 1995.0, 2000.0, 2003.7})
    for (const double width : {2.0, 10.0, 30.0}) {
      const auto here = of(depth, width), deeper = of(depth + step, width), wider = of(depth, width + step);
      for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_LE(std::abs(deeper[i] - here[i]), 1.01 * steepest * whole[i] + 1e-15);
        EXPECT_LE(std::abs(wider[i] - here[i]), 1.01 * steepest * whole[i] + 1e-15);
      }
    }
}

float shift_at(const ModelParts& parts, const Vec3& place) {
  return LayerTilt(parts.ice, parts.detector)
      .shift(static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z()));
}

Vec3 along_tilt(double distance, double z) {
  return {distance * std::cos(tilt_lines_direction), distance * std::sin(tilt_lines_direction), z};
}

TEST(TiltEffect, RisesFromTheCentralStringWhereIceWasFlat) {
  const ModelParts model = built_in_parts(), tilted = changed(model, {"tilt.slope=20"});
  EXPECT_TRUE(LayerTilt(model.ice, model.detector).is_flat());
  const float origin = shift_at(tilted, along_tilt(0, 100));
  EXPECT_LT(std::abs(origin), 0.02 * 80);  // a string near the origin
  for (const double distance : {-500.0, 300.0, 2000.0})
    for (const double z : {-700.0, 0.0, 400.0})
      EXPECT_NEAR(shift_at(tilted, along_tilt(distance, z)) - origin, 0.02 * distance, 1e-3);
}

TEST(TiltEffect, AddsToLines) {
  ModelParts model = small_parts();
  model.ice.tilt_map.reset();
  const ModelParts more = changed(model, {"tilt.slope=-30"});
  const double origin = model.detector.modules()[0].position.dot(along_tilt(1, 0));
  for (const double distance : {-600.0, 0.0, 100.0, 470.0}) {
    const Vec3 place = along_tilt(distance, 730);
    EXPECT_NEAR(shift_at(more, place) - shift_at(model, place), -0.03 * (distance - origin), 1e-3);
  }
}

TEST(TiltEffect, AddsToTheMapInsideItsBorder) {
  const ModelParts model = small_parts(), more = changed(model, {"tilt.slope=40"});
  for (const Vec3& place : {Vec3(0, 0, 740), Vec3(40, -30, 735), Vec3(-20, 50, 744)})
    EXPECT_NEAR(shift_at(more, place) - shift_at(model, place), 0.04 * place.dot(along_tilt(1, 0)), 1e-3);
}

// What is changed can be written, and is a model that other tools read.
TEST(IceEffects, GiveTablesThatCanBeWritten) {
  const ModelParts model = changed(
      built_in_parts(), {"birefringence.strength=0.7", "scattering-anisotropy.k1=0.1", "tilt.slope=9",
                         "absorption-layer.factor=2", "hole-ice.radius=0.5", "flow-azimuth.azimuth=-3",
                         "absorption-anisotropy.k1=0.1", "scattering-function.g=0.9"});
  const TemporaryDirectory directory;
  write_ice_tables(model.ice, directory.path());
  EXPECT_EQ(ice_hash(read_ice_tables(directory.path())), ice_hash(model.ice));
}

}  // namespace
}  // namespace floe::test

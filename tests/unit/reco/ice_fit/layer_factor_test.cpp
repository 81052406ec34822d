// A factor on some depths, which leaves the rest of the ice as it is.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/error.h"
#include "reco/ice_fit/ice_parameter.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

// Rows every 10 m from 1000 to 3000 m.
Model uniform_model(bool crystals) {
  IceTables tables = test::uniform_tables({25, 100});
  if (crystals) tables.configuration.birefringence = published_birefringence();
  return test::make_model(tables, {Vec3(0, 0, 0), Vec3(50, 0, 0)});
}

TEST(LayerFactor, ChangesTheRowsOfItsDepthsOnly) {
  const Model base = uniform_model(true);
  const IceParameter parameter = layer_factor(LayerFamily::scattering, 2000, 2100, base);
  EXPECT_EQ(parameter.name, "scattering 2000-2100 m");
  const Model changed = with_parameters(base, {parameter}, {std::log(1.3)});
  const auto &before = base.ice->tables().layers, &after = changed.ice->tables().layers;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool inside = before[i].depth >= 2000 && before[i].depth <= 2100;
    EXPECT_NEAR(after[i].effective_scattering, (inside ? 1.3 : 1) * before[i].effective_scattering, 1e-9);
    EXPECT_EQ(after[i].dust_absorption, before[i].dust_absorption);
    EXPECT_EQ(after[i].birefringence_strength, before[i].birefringence_strength);
  }
}

TEST(LayerFactor, OfOneIsTheBaseModel) {
  const Model base = uniform_model(true);
  for (const char* name : {"absorption", "scattering", "birefringence"}) {
    const IceParameter parameter = layer_factor(*layer_family_of(name), 1500, 1600, base);
    EXPECT_EQ(with_parameters(base, {parameter}, {parameter.start}).ice->hash(), base.ice->hash()) << name;
    EXPECT_NE(with_parameters(base, {parameter}, {0.1}).ice->hash(), base.ice->hash()) << name;
  }
  EXPECT_FALSE(layer_family_of("absorption-scale"));
}

TEST(LayerFactor, NeedsSomethingToChange) {
  EXPECT_THROW(layer_factor(LayerFamily::absorption, 3100, 3200, uniform_model(true)), UsageError);
  EXPECT_THROW(layer_factor(LayerFamily::birefringence, 1500, 1600, uniform_model(false)), UsageError);
}

// A step that meets a limit ends there, though the sum is rounded to a number beyond it.
TEST(IceParameter, StaysWithinItsLimitsWhateverIsRounded) {
  const Model base = uniform_model(true);
  const IceParameter scale = effect_parameter("absorption-scale", base);
  ASSERT_FALSE(scale.logarithmic);
  int beyond = 0;
  for (double number = 0.2; number < 2.5; number += 0.01) {
    const double sum = number + (scale.low - number);
    if (sum >= scale.low) continue;
    ++beyond;
    ASSERT_THROW(with_parameters(base, {scale}, {sum}), UsageError) << number;
    ASSERT_NO_THROW(with_parameters(base, {scale}, {scale.within(sum)})) << number;
  }
  EXPECT_GT(beyond, 0);
}

}  // namespace
}  // namespace floe

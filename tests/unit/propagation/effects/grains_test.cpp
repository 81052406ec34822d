// Grains of another size and shape.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/propagation/effects/changed_parts.h"

namespace floe::test {
namespace {

double mean_strength(const ModelParts& parts) {
  double sum = 0;
  for (const IceLayerRow& row : parts.ice.layers) sum += row.birefringence_strength;
  return sum / static_cast<double>(parts.ice.layers.size());
}

std::string elongation(double value) {
  return "grains.elongation=" + std::to_string(value);
}

// Of 1 m at strength 1, in the built-in ice, which has the numbers of SpiceBFR v2.
DiffusionStep step_at(double angle, const std::vector<std::string>& settings) {
  const ModelParts parts = changed(built_in_parts(), settings);
  return diffusion_step(*parts.ice.configuration.birefringence, std::cos(angle * degree));
}

TEST(GrainsEffect, NullValuesAreTheModels) {
  const auto parameters = find_effect("grains").parameters(built_in_parts());
  EXPECT_EQ(parameters[0].name, "size");
  EXPECT_NEAR(parameters[0].null_value, 1 / mean_strength(built_in_parts()), 1e-12);
  EXPECT_EQ(parameters[1].name, "elongation");
  EXPECT_EQ(parameters[1].null_value, 1.4);
}

TEST(GrainsEffect, SizeDividesTheStrengthOfEveryLayer) {
  const ModelParts model = built_in_parts(), coarse = changed(model, {"grains.size=2"});
  EXPECT_NEAR(mean_strength(coarse), 0.5, 1e-12);
  const double ratio =
      coarse.ice.layers[0].birefringence_strength / model.ice.layers[0].birefringence_strength;
  for (std::size_t i = 0; i < model.ice.layers.size(); ++i) {
    EXPECT_NEAR(coarse.ice.layers[i].birefringence_strength,
                ratio * model.ice.layers[i].birefringence_strength, 1e-12);
    EXPECT_EQ(coarse.ice.layers[i].deflection_strength, model.ice.layers[i].deflection_strength);
  }
  const auto &was = model.ice.configuration.birefringence, &is = coarse.ice.configuration.birefringence;
  EXPECT_EQ(is->sigma_x.A, was->sigma_x.A);
  EXPECT_EQ(is->sigma_y.B, was->sigma_y.B);
  EXPECT_EQ(is->mean_x.A, was->mean_x.A);
}

TEST(GrainsEffect, SizeIsThatOfTheIceWhateverItsStrengthWas) {
  expect_equal(changed(built_in_parts(), {"birefringence.strength=0.5", "grains.size=1.25"}),
               changed(changed(built_in_parts(), {"birefringence.strength=0.5"}), {"grains.size=1.25"}));
  EXPECT_NEAR(mean_strength(changed(built_in_parts(), {"birefringence.strength=0.5", "grains.size=1.25"})),
              0.8, 1e-12);
}

// Long grains turn light along the flow more, across it less, and pull it towards the flow.
TEST(GrainsEffect, ElongationIsMonotone) {
  DiffusionStep along = step_at(0, {elongation(1)}), across = step_at(90, {elongation(1)}),
                between = step_at(15, {elongation(1)});
  for (double value = 1.1; value < 3.01; value += 0.1) {
    const DiffusionStep longer = step_at(0, {elongation(value)}), aside = step_at(90, {elongation(value)}),
                        middle = step_at(15, {elongation(value)});
    EXPECT_GT(longer.sigma_x, 1.005 * along.sigma_x) << value;
    EXPECT_GT(longer.sigma_y, 1.005 * along.sigma_y) << value;
    EXPECT_LT(aside.sigma_x, 0.99 * across.sigma_x) << value;
    EXPECT_NEAR(aside.sigma_y, across.sigma_y, 0.05 * across.sigma_y) << value;
    EXPECT_GT(middle.mean_x, 1.02 * between.mean_x) << value;
    along = longer, across = aside, between = middle;
  }
}

// A fit that moves the elongation must see neither steps nor bends.
TEST(GrainsEffect, ElongationIsSmoothWhereNothingChanges) {
  constexpr double step = 1e-4;
  for (const double angle : {1.0, 20.0, 50.0, 89.0}) {
    const DiffusionStep here = step_at(angle, {}), more = step_at(angle, {elongation(1.4 + step)}),
                        less = step_at(angle, {elongation(1.4 - step)});
    for (const auto number : {&DiffusionStep::sigma_x, &DiffusionStep::sigma_y, &DiffusionStep::mean_x}) {
      const double forward = (more.*number - here.*number) / step,
                   backward = (here.*number - less.*number) / step;
      EXPECT_LT(std::abs(forward), 4 * here.*number) << angle;
      EXPECT_NEAR(forward, backward, 1e-3 * here.*number) << angle;
    }
  }
}

TEST(GrainsEffect, CrystalsShareOfScatteringFollows) {
  const ModelParts longer = changed(built_in_parts(), {elongation(1.8)});
  const IceModel before(built_in_parts().ice, built_in_parts().detector), after(longer.ice, longer.detector);
  EXPECT_GT(after.birefringent_scattering(), 1.1 * before.birefringent_scattering());
  EXPECT_LT(after.effective_scattering(50, 400), before.effective_scattering(50, 400));
}

// Directories hold the twelve numbers and the strengths: what is changed can be written.
TEST(GrainsEffect, CanBeWritten) {
  const ModelParts model = changed(built_in_parts(), {"grains.size=0.6", elongation(2.3)});
  const TemporaryDirectory directory;
  write_ice_tables(model.ice, directory.path());
  EXPECT_EQ(ice_hash(read_ice_tables(directory.path())), ice_hash(model.ice));
}

TEST(GrainsEffect, NeedsBirefringence) {
  ModelParts none = built_in_parts();
  switch_off(none.ice, "birefringence");
  expect_refused(none, {"grains.size=2"}, "birefringence.strength=1");
  expect_refused(none, {"grains.elongation=2"}, "no birefringence");
  const ModelParts both = changed(none, {"birefringence.strength=1", "grains.elongation=2"});
  expect_equal(both, changed(built_in_parts(), {"grains.elongation=2"}));
}

TEST(GrainsEffect, HasARange) {
  expect_refused(built_in_parts(), {"grains.elongation=0.9"}, "from 1 to 3");
  expect_refused(built_in_parts(), {"grains.size=0"}, "mm");
}

}  // namespace
}  // namespace floe::test

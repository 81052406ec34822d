// The effect `grains` against light that walks through grains of that shape, at elongations between those
// that its numbers were made from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "propagation/crystal/pattern_grid.h"
#include "propagation/effects/effect.h"
#include "propagation/ice/ice_model.h"
#include "propagation/model.h"

namespace floe {
namespace {

// What floe's own crystals give at elongation 1.4; published numbers would add their own differences.
BirefringenceNumbers numbers_at_1_4() {
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.09118, 11515.8, 2.0173, 0.01};
  numbers.sigma_y = {0.09048, 33725.1, 2.3055, 0.01};
  numbers.mean_x = {0.001899, 0.7066, 1.9771, 1.680717};
  return numbers;
}

BirefringenceNumbers numbers_at(double elongation) {
  ModelParts parts = parts_of(load_model({}));
  parts.ice.configuration.birefringence = numbers_at_1_4();
  apply_effects(std::vector<EffectSetting>{{"grains", "elongation", elongation}}, parts);
  return *parts.ice.configuration.birefringence;
}

std::vector<CrystalPattern> patterns_at(double elongation) {
  PatternGrid grid;
  grid.crystal = {
      {1.3185, 1.3200}, Fabric::from_eigenvalues(fabric_eigenvalues(0.1, 4)), spheroid(elongation)};
  for (const double angle : {0.0, 10.0, 20.0, 40.0, 65.0, 90.0}) grid.angles.push_back(angle * degree);
  grid.photons = 5000;
  grid.seed = 3;
  return walk_grid(grid);
}

// Of a number's distances from the functions of `numbers`: the largest, in units of what is allowed: 4 errors
// of the pattern, and what the functions are known to miss, 6% of a width and a tenth of the largest
// deflection.
double largest_distance(const std::vector<CrystalPattern>& patterns, const BirefringenceNumbers& numbers,
                        PatternNumber number, double DiffusionStep::*value) {
  const bool is_width = number != PatternNumber::mean_x;
  double largest_value = 0, largest = 0;
  for (const CrystalPattern& pattern : patterns)
    largest_value = std::max(largest_value, diffusion_step(numbers, std::cos(pattern.angle)).*value);
  for (const CrystalPattern& pattern : patterns) {
    const double expected = diffusion_step(numbers, std::cos(pattern.angle)).*value;
    const Estimate& found = pattern.statistics[number];
    const double missed = is_width ? 0.06 * expected : 0.1 * largest_value;
    largest = std::max(largest, std::abs(found.value - expected) / (4 * found.error + missed));
  }
  return largest;
}

class Grains : public ::testing::TestWithParam<double> {};

TEST_P(Grains, ChangeWidthsAndDeflectionAsTheirCrystalsDo) {
  const double elongation = GetParam();
  const std::vector<CrystalPattern> patterns = patterns_at(elongation);
  const BirefringenceNumbers numbers = numbers_at(elongation);
  EXPECT_LT(largest_distance(patterns, numbers, PatternNumber::sigma_x, &DiffusionStep::sigma_x), 1);
  EXPECT_LT(largest_distance(patterns, numbers, PatternNumber::sigma_y, &DiffusionStep::sigma_y), 1);
  EXPECT_LT(largest_distance(patterns, numbers, PatternNumber::mean_x, &DiffusionStep::mean_x), 1);
  // The tolerances can tell: other grains are not taken for these.
  const BirefringenceNumbers other = numbers_at(elongation < 2 ? 2 : 1.55);
  EXPECT_GT(largest_distance(patterns, other, PatternNumber::sigma_x, &DiffusionStep::sigma_x), 1);
  EXPECT_GT(largest_distance(patterns, other, PatternNumber::mean_x, &DiffusionStep::mean_x), 1);
}

INSTANTIATE_TEST_SUITE_P(Elongations, Grains, ::testing::Values(1.1, 1.55, 2.25),
                         [](const auto& grains) { return std::to_string(std::lround(100 * grains.param)); });

}  // namespace
}  // namespace floe

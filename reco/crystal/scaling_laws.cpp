#include "reco/crystal/scaling_laws.h"

#include <cmath>
#include <limits>

namespace floe {

namespace {

constexpr int fewest_crossings = 10;

// value/expected, expected having an error of its own.
Estimate ratio_of(const Estimate& value, const Estimate& expected) {
  const double ratio = value.value / expected.value;
  return {ratio, std::hypot(value.error / expected.value, ratio * expected.error / expected.value)};
}

void compare(const CrystalPattern& shorter, const CrystalPattern& whole, std::vector<ScalingCheck>& checks) {
  const double share = static_cast<double>(shorter.crossings) / whole.crossings;
  using enum PatternNumber;
  const auto add = [&](PatternNumber number, double factor, double largest_error) {
    Estimate expected = whole.statistics[number];
    expected = {factor * expected.value, factor * expected.error};
    const Estimate ratio = ratio_of(shorter.statistics[number], expected);
    if (ratio.error < largest_error) checks.push_back({whole.angle, shorter.crossings, number, ratio});
  };
  constexpr double any = std::numeric_limits<double>::infinity(), known = 0.2;
  for (const PatternNumber width : {core_sigma_x, core_sigma_y, sigma_x, sigma_y})
    add(width, std::sqrt(share), any);
  for (const PatternNumber deflection : {core_mean_x, mean_x}) add(deflection, share, known);
}

}  // namespace

bool ScalingCheck::fails() const {
  return std::abs(ratio.value - 1) > 3 * ratio.error && std::abs(ratio.value - 1) > 0.05;
}

std::vector<ScalingCheck> check_scaling(const PatternGrid& grid, const std::vector<CrystalPattern>& patterns,
                                        const Progress& progress) {
  std::vector<ScalingCheck> checks;
  for (const int part : {100, 10, 3}) {
    PatternGrid shorter = grid;
    shorter.crossings = grid.crossings / part;
    if (shorter.crossings < fewest_crossings) continue;
    // Other photons than the grid's own, so that the two are independent.
    shorter.first_photon = grid.first_photon + grid.photons * static_cast<std::uint64_t>(part);
    const std::vector<CrystalPattern> found = walk_grid(shorter, progress);
    for (std::size_t i = 0; i < found.size(); ++i) compare(found[i], patterns[i], checks);
  }
  return checks;
}

}  // namespace floe

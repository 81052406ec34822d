#include "propagation/crystal/pattern_grid.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

CrystalWalk walk_at(const PatternGrid& grid, double angle) {
  if (!grid.chords) return {angle, grid.crossings, grid.grain};
  const double chord = relative_chord(grid.crystal.grains, {std::cos(angle), std::sin(angle), 0});
  const int crossings = std::max(1, static_cast<int>(std::lround(grid.crossings / chord)));
  return {angle, crossings, grid.crossings * grid.grain / crossings};
}

}  // namespace

std::vector<CrystalPattern> walk_grid(const PatternGrid& grid, const Progress& progress) {
  std::vector<CrystalPattern> patterns;
  const auto angles = static_cast<double>(grid.angles.size());
  for (std::size_t i = 0; i < grid.angles.size(); ++i) {
    const CrystalWalk walk = walk_at(grid, grid.angles[i]);
    const auto share = [&](double fraction, const std::string& stage) {
      progress((static_cast<double>(i) + fraction) / angles, stage);
    };
    std::vector<WalkedPhoton> photons =
        walk_photons(grid.crystal, walk, {grid.seed, i, grid.first_photon}, grid.photons, grid.threads,
                     progress ? Progress(share) : Progress());
    const double length = walk.crossings * walk.step;
    const PatternStatistics statistics(photons, length);
    patterns.push_back({grid.angles[i], walk.crossings, length, std::move(photons), statistics});
  }
  return patterns;
}

}  // namespace floe

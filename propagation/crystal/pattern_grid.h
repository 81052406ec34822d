// Diffusion patterns over a grid of angles to the flow.
#pragma once

#include <vector>

#include "propagation/crystal/pattern.h"

namespace floe {

struct PatternGrid {
  Polycrystal crystal;
  std::vector<double> angles;  // to the flow [rad], in [0, pi/2]
  int crossings = 1000;        // on each path; with `chords`, their mean over isotropic directions
  double grain = 1e-3;         // mean distance between crossings [m]; with `chords`, 4 V/surface of a grain
  // Steps have the grains' mean chord in the photon's first direction: paths are equally long in all
  // directions and meet more boundaries across elongated grains than along them. Otherwise, as in
  // arXiv:2107.08692, the distance between crossings is the same in all directions.
  bool chords = false;
  std::uint64_t seed = 1, first_photon = 0;
  std::size_t photons = 10000;  // of each angle
  int threads = 0;              // 0: all cores
};

struct CrystalPattern {
  double angle;   // [rad]
  int crossings;  // each photon's
  double length;  // of each photon's path [m]
  std::vector<WalkedPhoton> photons;
  PatternStatistics statistics;
};

// In the order of the angles. Photon i of an angle is the same whatever `photons` and `threads` are, so that
// shares of a pattern can be made apart, with other first photons.
std::vector<CrystalPattern> walk_grid(const PatternGrid& grid, const Progress& progress = {});

}  // namespace floe

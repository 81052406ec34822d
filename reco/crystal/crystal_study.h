// What floe crystal finds of one kind of ice: patterns, their 12 numbers, and how they scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reco/crystal/diffusion_fit.h"
#include "reco/crystal/scaling_laws.h"

namespace floe {

struct CrystalStudy {
  std::string name;    // "elongation 1.4, fabric 0.1,4"
  std::string fabric;  // as it was given
  PatternGrid grid;
  std::vector<CrystalPattern> patterns;
  std::optional<DiffusionFit> core, all;  // none with fewer than 5 angles
  std::vector<ScalingCheck> scaling;      // empty unless asked for
};

// Of patterns that were walked already, `grid.photons` of each of the grid's angles.
CrystalStudy study_patterns(const std::string& name, const std::string& fabric, const PatternGrid& grid,
                            std::vector<CrystalPattern> patterns);
CrystalStudy study_crystal(const std::string& name, const std::string& fabric, const PatternGrid& grid,
                           bool with_scaling, const Progress& progress = {});

}  // namespace floe

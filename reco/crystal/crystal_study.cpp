#include "reco/crystal/crystal_study.h"

#include <utility>

namespace floe {

CrystalStudy study_patterns(const std::string& name, const std::string& fabric, const PatternGrid& grid,
                            std::vector<CrystalPattern> patterns) {
  constexpr std::size_t fewest_angles = 5;
  CrystalStudy study{name, fabric, grid, std::move(patterns), {}, {}, {}};
  if (grid.angles.size() >= fewest_angles) {
    study.core = fit_diffusion(study.patterns, grid.grain, PatternEstimator::core);
    study.all = fit_diffusion(study.patterns, grid.grain, PatternEstimator::all);
  }
  return study;
}

CrystalStudy study_crystal(const std::string& name, const std::string& fabric, const PatternGrid& grid,
                           bool with_scaling, const Progress& progress) {
  CrystalStudy study = study_patterns(name, fabric, grid, walk_grid(grid, progress));
  if (with_scaling) study.scaling = check_scaling(grid, study.patterns, progress);
  return study;
}

}  // namespace floe

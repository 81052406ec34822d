// A ladder of ice models, each refitted to the same flasher data: which description of anisotropy do the data
// want? (arXiv:2107.08692 compares the same ones.)
#pragma once

#include <string>
#include <vector>

#include "reco/ice_fit/ice_fit.h"

namespace floe {

struct LadderOptions {
  IceFitOptions fit;
  int folds = 2;  // each run is held out once, together with the others of its fold; 2 to the number of runs
};

struct LadderRung {
  std::string name;
  IceFit fit;                    // to all runs
  std::vector<double> held_out;  // -ln L of each run under a fit that has not seen it
  double total() const;
};

struct Ladder {
  std::vector<std::string> runs;      // names, in the order of held_out
  std::vector<std::string> left_out;  // of the data, a sentence each
  std::vector<LadderRung> rungs;      // from the plainest up
  std::size_t best() const;           // least held-out -ln L
  // How much worse a rung is than the best, and the standard error of that: from the scatter over runs.
  struct Gap {
    double value = 0, error = 0;
  };
  Gap gap(std::size_t rung) const;
};

// Isotropic ice, absorption anisotropy, scattering anisotropy, birefringence, birefringence and absorption
// anisotropy: the base model without any of them, with the strengths of those on the rung and scales of all
// absorption and scattering fitted. Throws UsageError (fewer than two runs, folds out of range) and what
// fit_ice throws.
Ladder climb_ladder(const Model& base, const FlasherData& data, const LadderOptions& options,
                    const Progress& progress = {});

}  // namespace floe

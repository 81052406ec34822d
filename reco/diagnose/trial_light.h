// Light of the flasher runs of blind trials, simulated with any model: as hits, as counts in the bins of a
// survey, or as data that a diagnosis takes.
#pragma once

#include <cstdint>
#include <vector>

#include "data/flasher_run.h"
#include "propagation/model.h"
#include "reco/diagnose/score_values.h"
#include "reco/diagnose/survey.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_light.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

struct RunOfTrials {
  FlasherRun run;
  double repeats = 1;  // of the flash, each with noise of its own

  double photons() const { return run.photons * repeats; }
};

class TrialLight {
 public:
  // By run.
  using Hits = std::vector<std::vector<SimulatedHit>>;

  // Keeps references to all of them.
  TrialLight(const Detector& detector, const std::vector<RunOfTrials>& runs, const RunSettings& settings)
      : detector_(detector), runs_(runs), settings_(settings) {}

  RunRequest request(std::size_t run, std::uint64_t stream) const;
  // As many photons as the runs have; each run has a stream of its own, from `stream` on. `survey`: whose
  // runs say when noise is taken; without it there is none.
  Hits hits(const Model& model, std::uint64_t stream, const Survey* survey = nullptr) const;
  // As many as the survey has.
  LightInBins in_bins(const Model& model, std::uint64_t stream, const Survey& survey) const;

  FlasherData data_of(const Hits& hits) const;
  static SurveyCounts counts_of(const Hits& hits, const Survey& survey);

 private:
  std::vector<SimulatedHit> hits_of(const Model& model, std::size_t run, std::uint64_t stream, double photons,
                                    const Survey* survey) const;

  const Detector& detector_;
  const std::vector<RunOfTrials>& runs_;
  const RunSettings& settings_;
};

}  // namespace floe

// The light of one flasher run in a model: expected counts per bin, and how they depend on a fit's
// parameters.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "data/flasher_run.h"
#include "data/readout.h"
#include "propagation/engine/noise_hits.h"
#include "propagation/model.h"
#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/score_map.h"

namespace floe {

// Half of a simulation: even or odd photons. What one half says must not be judged by the same half, since
// a product of two noisy numbers is right on average only when their noise is independent.
struct LightFold {
  Eigen::VectorXd counts;         // simulated hits per bin
  Eigen::MatrixXd slopes;         // bins x parameters: d counts / d parameter
  Eigen::MatrixXd slope_squares;  // sums of the squares that went into `slopes`: their variance
  Eigen::MatrixXd dwell;          // bins x parameters: path where the parameter acts, summed over hits [m]
  Eigen::VectorXd delay;          // d counts / d time zero [1/ns]

  LightFold& operator+=(const LightFold& other);
};

struct RunLight {
  LightFold folds[2];
  double photons = 0;      // N that each fold stands for (FlasherSettings::photons)
  Eigen::MatrixXd places;  // of the bins, for smooth slopes
  // By parameter: whether slopes have the symmetry of the ice about the flasher, and whether they come from
  // photons of their own.
  std::vector<char> symmetric, independent;
};

struct RunRequest {
  FlasherRun run;
  double photons = 0;  // N, both folds together
  double oversize = 16;
  std::uint64_t seed = 1, stream = 0;
  int threads = 0;
  // In which noise is simulated, too; readouts of one N.
  NoiseWindow noise = {0, 0, 0};
  ExpectedAfterpulses afterpulses = {.share = 0};
  std::vector<ExpectedDelay> delays = {};  // of the pulses of light
};

// All hits of a run.
struct SimulatedRun {
  std::vector<SimulatedHit> hits;
  std::uint64_t propagated = 0;
};
SimulatedRun simulate_run(const Model& model, const RunRequest& request);

// Counts only.
RunLight count_light(const SimulatedRun& run, const RunBins& bins, double photons, int parameters);
// And slopes, by walking the detected photons again; `time_zero`: by how much the run's hits were moved.
RunLight light_with_slopes(const Model& model, const RunRequest& request, const SimulatedRun& run,
                           const RunBins& bins, const ScoreMap& map, double time_zero);

}  // namespace floe

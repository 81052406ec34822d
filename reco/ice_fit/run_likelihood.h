// How well a model describes a flasher run: fresh simulation, likelihood with its limited size.
#pragma once

#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// A run's own numbers, of no interest for the ice.
struct RunNuisances {
  double brightness = 0;  // N of all flashes together
  double time_zero = 0;   // [ns]
};

struct RunMeasurement {
  double neg_llh = 0;      // saturated: 0 for perfect agreement (reco/likelihood/limited_simulation.h)
  RunNuisances nuisances;  // that minimise it
  int bins = 0;
};

// Hits of used receivers.
double used_hits(const SimulatedRun& simulated, const RunData& run);
// Variance of sums of hits over that of independent ones: a photon may be seen more than once. >= 1
double dispersion(const SimulatedRun& simulated);
// Moves all hits in time [ns].
void delay(SimulatedRun& simulated, double time);

// Counts of one run in bins.
struct ComparedCounts {
  Eigen::VectorXd data, simulated;
  double photons = 0;  // N of the simulation; both in units of independent hits
};
// At the best brightness; `brightness`: where to look first.
RunMeasurement measure_counts(const ComparedCounts& counts, double brightness, double model_error);

// The likelihood of a run's counts at the best nuisances, the time zero in whole ns within 20 ns of the
// start. `photons`: N of the simulation; `start`: where to look for them first; brightness 0: from the number
// of hits.
RunMeasurement measure_run(const SimulatedRun& simulated, double photons, const RunData& run,
                           const RunBins& bins, const RunNuisances& start, double model_error);
// The same, with the time zero to an eighth of a ns: bright light tells it better than steps of the search.
RunMeasurement measure_run_finely(const SimulatedRun& simulated, double photons, const RunData& run,
                                  const RunBins& bins, const RunNuisances& start, double model_error);

}  // namespace floe

// How much light of each run is simulated, and in which bins it is compared: the same for fits and scans.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// How run number `run` is simulated with this N. Of the first look, the bins and what is compared with the
// data, each must have streams of its own.
using RequestOfRun = std::function<RunRequest(std::size_t run, double photons)>;

struct FirstLook {
  std::vector<double> hits_per_photon;  // by run: simulated hits of used receivers for N = 1, above 0
  std::vector<double> brightness;       // by run: N of the data, all flashes together, without dark noise
  std::uint64_t propagated = 0;
};

// Simulates a little of every run, and leaves out receivers that cannot be right (leave_out_bad_receivers).
FirstLook look_first(const Model& model, const RequestOfRun& request, FlasherData& data);

// Takes a run out of both, with a sentence.
void leave_out_run(std::size_t run, const std::string& why, FlasherData& data, FirstLook& look);

// Leaves out runs of which no receiver is left, with a sentence. Throws NoResult when no run is.
void leave_out_dark_runs(FlasherData& data, FirstLook& look);

struct LightBudget {
  double light = 5;            // simulated light, in units of the data's, at least
  double least_hits = 3e4;     // simulated hits of a run, at least
  double most_photons = 2e11;  // N of a run's simulation, at most

  // So many times the light, and at least so many times the hits.
  LightBudget& operator*=(double times) {
    light *= times, least_hits *= times;
    return *this;
  }
};

// How runs are simulated and compared with the data.
struct RunSettings {
  double oversize = 16;  // of the simulations, 1-100
  LightBudget light;
  double model_error = 0;  // relative, of every bin's expectation
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores; the result does not depend on it
};
void check(const RunSettings& settings);  // throws UsageError for values out of range

// N of a run's simulation.
double photons_wanted(const RunData& run, double hits_per_photon, const LightBudget& budget);

// When a run of this brightness, N of the data, has dark noise; none while that is not known yet (0). Noise
// of a readout lasts as long as its pulses do.
NoiseWindow noise_window(const RunData& run, double brightness);

// A run as it is simulated: N photons, with the noise and the afterpulses of its record.
RunRequest request_of(const RunData& run, const RunSettings& settings, double photons, std::uint64_t stream,
                      double brightness = 0);

// What tells a run's bins: a simulation of a share of its light, `request.photons` being all of it, moved by
// `time_zero` [ns]. It favours no data, and is independent of simulations with other streams.
struct Scout {
  SimulatedRun simulated;
  double photons = 0;  // N
};
Scout scout_run(const Model& model, RunRequest request, double time_zero);
// Where light is expected: dark noise and afterpulses are everywhere and tell nothing of the ice.
// `brightness`: expected counts of the data, all flashes together, for a simulated hit of N = 1.
RunBins bins_of(const Scout& scout, const RunData& run, double brightness);

// How a run is compared with simulations when its time zero is not yet known: a scout finds it, and bins go
// with it, as late as the light is in the data.
struct RunView {
  RunBins bins;
  double time_zero = 0;  // [ns]
  std::uint64_t propagated = 0;
};
RunView view_run(const Model& model, const RunRequest& request, const RunData& run, double brightness,
                 double model_error);

}  // namespace floe

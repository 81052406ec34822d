// The two pieces of work whose speed is compared everywhere: a flasher in mid detector and a deep cascade.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

struct Workload {
  std::string name, description;
};
// "flasher": module 63,20, its LEDs' reference line, symmetric in azimuth; "cascade": an electron at
// x 20, y -40, z -300 m that comes from zenith 70, azimuth 130 deg.
const std::vector<Workload>& workloads();
const Workload& workload_of(const std::string& name);  // throws UsageError naming those that exist

// How bright the source is: photons N of the flasher, before the detector's factors and the line's cut to
// its middle; energy [GeV] of the cascade.
inline constexpr double reference_flasher_photons = 2e9, reference_cascade_energy = 50000;
double reference_brightness(const Workload& workload);

std::unique_ptr<Source> make_source(const Workload& workload, const Model& model, double brightness);

// The brightness of a source of which `photons` are propagated, all in all.
double brightness_for(const Workload& workload, const Simulator& simulator, double photons);

// What a run took; the processor's time counts all threads.
struct TimedRun {
  SimulationSummary summary;
  double cpu_seconds;
};
// Propagates that many photons of the source, and drops the hits.
TimedRun run_photons(const Simulator& simulator, const Source& source, double photons, std::uint64_t seed,
                     int threads);

}  // namespace floe

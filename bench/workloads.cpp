#include "bench/workloads.h"

#include <fmt/format.h>

#include <ctime>
#include <span>
#include <utility>

#include "apps/planned_light.h"
#include "data/base/error.h"

namespace floe {

namespace {

const char* const flasher = "flasher";
const char* const cascade = "cascade";

SourceRequest light_of(const Workload& workload, double brightness) {
  SourceRequest light;
  if (workload.name == flasher) {
    light.flasher = FlasherRequest{};
    light.flasher->module = {63, 20};
    light.flasher->photons = brightness;
  } else {
    light.cascade = Cascade{{20, -40, -300}, 0, 70 * degree, 130 * degree, brightness};
  }
  return light;
}

// Of the calling process.
double cpu_seconds_now() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

const std::vector<Workload>& workloads() {
  static const std::vector<Workload> all{{flasher, "LEDs of module 63,20"},
                                         {cascade, "electron at z = -300 m, as of 50 TeV"}};
  return all;
}

const Workload& workload_of(const std::string& name) {
  for (const Workload& workload : workloads())
    if (workload.name == name) return workload;
  throw UsageError(fmt::format("unknown workload \"{}\"; known are {} and {}", name, flasher, cascade));
}

double reference_brightness(const Workload& workload) {
  return workload.name == flasher ? reference_flasher_photons : reference_cascade_energy;
}

std::unique_ptr<Source> make_source(const Workload& workload, const Model& model, double brightness) {
  constexpr std::uint64_t seed = 1;  // of fluctuations in brightness, which neither of the two has
  return std::move(plan_light(light_of(workload, brightness), model, seed).front().sources.front().source);
}

double brightness_for(const Workload& workload, const Simulator& simulator, double photons) {
  const double reference = reference_brightness(workload);
  const auto source = make_source(workload, simulator.model(), reference);
  return reference * photons / simulator.photons_to_propagate(*source);
}

TimedRun run_photons(const Simulator& simulator, const Source& source, double photons, std::uint64_t seed,
                     int threads) {
  SimulationOptions options;
  options.seed = seed;
  options.threads = threads;
  options.scale = photons / simulator.photons_to_propagate(source);
  options.fixed_number = true;
  const double before = cpu_seconds_now();
  TimedRun run{simulator.run(source, options, [](std::span<const SimulatedHit>) {}), 0};
  run.cpu_seconds = cpu_seconds_now() - before;
  return run;
}

}  // namespace floe

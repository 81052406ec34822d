// What `floe simulate` is asked for, turned into sources of light.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/flasher_runs_file.h"
#include "apps/planned_output.h"
#include "apps/point_options.h"
#include "data/event.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/source.h"

namespace floe {

struct FlasherRequest {
  ModuleId module;
  double photons = 0;                // N, see propagation/sources/flasher.h
  std::optional<double> wavelength;  // [nm]; none: the middle of the 405 nm line
  double width_deg = 9.7;
  double elevation_deg = -0.2;
  std::optional<double> azimuth_deg;
  bool isotropic = false;
  std::optional<MeasuredCurve> beam = {}, pulse = {};  // in place of width_deg, and of a flash at once
};

// Exactly one of these is set.
struct SourceRequest {
  std::optional<FlasherRequest> flasher;
  std::optional<std::vector<RunToSimulate>> flashers;
  std::optional<Cascade> cascade;
  std::optional<std::string> f2k;  // a file
  std::optional<PointRequest> point;
};
Json to_json(const SourceRequest& request);

// Sources hold tables, and a file may have many thousand of them: each is made when its turn comes.
struct PlannedSource {
  std::function<std::unique_ptr<Source>()> make;
  double photons = 0;         // to propagate
  bool fixed_number = false;  // emits its number of photons exactly, instead of a Poisson draw
};
struct PlannedEvent {
  std::string id;
  std::vector<Particle> truth;
  std::vector<PlannedSource> sources;
  // The sources hold the light of all repetitions; the event is an average over them.
  double repeats = 1;
  std::optional<FlasherRun> flasher = {};
  double share = 1;  // of the sources' light that is simulated; `repeats` knows of it

  double photons() const;  // of all sources, before any share
};

// The events of the request, in order, for a simulator that outlives them. `seed` draws how bright hadronic
// cascades are. Throws InputError: unknown module, malformed f2k, a particle that cannot be simulated.
std::vector<PlannedEvent> plan_light(const SourceRequest& request, const Simulator& simulator,
                                     std::uint64_t seed);

}  // namespace floe

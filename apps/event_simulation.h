// Planned events, simulated one after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/planned_light.h"
#include "apps/planned_output.h"
#include "data/event_files.h"
#include "propagation/engine/simulator.h"

namespace floe {

// What one event came to.
struct EventResult {
  std::string id;
  SimulationSummary summary;
  double share = 1;  // of its photons that was simulated
  double repeats = 1;
  std::size_t modules = 0;  // that were hit
};
Json to_json(const EventResult& result);
EventResult event_result_of(const Json& json);  // without what no report names: scatters and queries
// Three numbers, each the number of hits when they have no weights.
void put_weights(const WeightSums& weights, Json& json);

void add(const SimulationSummary& part, SimulationSummary& sum);

// Each source has random numbers of its own: an event comes out the same whichever were simulated before it.
class EventSimulation {
 public:
  // Of `usual` stream, scale and fixed_number are set for each source. All must outlive the simulation.
  EventSimulation(const Simulator& simulator, const std::vector<PlannedEvent>& events,
                  const SimulationOptions& usual, Progress progress);

  // Begins the event in the file and appends its hits, the modules' noise among them.
  EventResult simulate(std::size_t event, EventFileWriter& writer);
  // Done by an earlier run.
  void pass_over(std::size_t event);

 private:
  double share_of(double photons) const;  // among all events'
  void simulate_source(const Source& source, const SimulationOptions& options, double share,
                       EventFileWriter& writer, EventResult& result);
  void add_noise(const PlannedEvent& event, std::optional<std::size_t> emitter, std::uint64_t stream,
                 EventFileWriter& writer, EventResult& result);
  void write(std::span<const SimulatedHit> hits, double repeats, EventFileWriter& writer);

  const Simulator& simulator_;
  const std::vector<PlannedEvent>& events_;
  SimulationOptions usual_;
  Progress progress_;
  std::vector<std::uint64_t> first_streams_;  // of each event
  std::set<std::uint32_t> modules_;           // that the event has hit
  double photons_ = 0, done_ = 0;             // of all events; share that is done
};

}  // namespace floe

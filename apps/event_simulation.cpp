#include "apps/event_simulation.h"

#include <algorithm>
#include <memory>

#include "propagation/engine/noise_hits.h"

namespace floe {

void put_weights(const WeightSums& weights, Json& json) {
  json["weight_sum"] = weights.sum;
  json["squared_weight_sum"] = weights.squares;
  json["effective_hits"] = weights.effective_hits();
}

Json to_json(const EventResult& result) {
  const SimulationSummary& summary = result.summary;
  Json json = {{"event", result.id},
               {"photons_propagated", summary.propagated},
               {"hits", summary.hits},
               {"modules_hit", result.modules},
               {"share_simulated", result.share},
               {"repeats", result.repeats}};
  put_weights(summary.weights, json);
  json["seconds"] = summary.seconds;
  return json;
}

EventResult event_result_of(const Json& json) {
  EventResult result{
      json.at("event"), {}, json.at("share_simulated"), json.at("repeats"), json.at("modules_hit")};
  SimulationSummary& summary = result.summary;
  json.at("photons_propagated").get_to(summary.propagated);
  json.at("hits").get_to(summary.hits);
  json.at("seconds").get_to(summary.seconds);
  summary.weights = {summary.hits, json.at("weight_sum"), json.at("squared_weight_sum")};
  return result;
}

void add(const SimulationSummary& part, SimulationSummary& sum) {
  sum.propagated += part.propagated;
  sum.hits += part.hits;
  sum.weights += part.weights;
  sum.seconds += part.seconds;
}

EventSimulation::EventSimulation(const Simulator& simulator, const std::vector<PlannedEvent>& events,
                                 const SimulationOptions& usual, Progress progress)
    : simulator_(simulator), events_(events), usual_(usual), progress_(std::move(progress)) {
  std::uint64_t stream = 0;
  for (const PlannedEvent& event : events) {
    first_streams_.push_back(stream);
    stream += event.sources.size();
    photons_ += event.share * event.photons();
  }
}

double EventSimulation::share_of(double photons) const {
  return photons_ > 0 ? photons / photons_ : 0;
}

void EventSimulation::pass_over(std::size_t event) {
  done_ += share_of(events_[event].share * events_[event].photons());
}

EventResult EventSimulation::simulate(std::size_t number, EventFileWriter& writer) {
  const PlannedEvent& event = events_[number];
  EventResult result{event.id, {}, event.share, event.repeats};
  modules_.clear();
  writer.begin_event(event.id, event.truth, event.repeats, event.flasher);
  SimulationOptions options = usual_;
  options.scale = event.share;
  options.stream = first_streams_[number];
  std::optional<std::size_t> emitter;
  for (const PlannedSource& planned : event.sources) {
    const std::unique_ptr<Source> source = planned.make();
    if (!emitter) emitter = source->emitting_module();
    options.fixed_number = planned.fixed_number;
    const double share = share_of(event.share * planned.photons);
    simulate_source(*source, options, share, writer, result);
    done_ += share;
    ++options.stream;
  }
  add_noise(event, emitter, options.stream, writer, result);
  result.modules = modules_.size();
  return result;
}

void EventSimulation::simulate_source(const Source& source, const SimulationOptions& options, double share,
                                      EventFileWriter& writer, EventResult& result) {
  const auto sink = [&](std::span<const SimulatedHit> hits) { write(hits, result.repeats, writer); };
  Progress progress;
  if (progress_)
    progress = [&](double fraction, const std::string&) {
      progress_(done_ + share * fraction, "simulating " + result.id);
    };
  add(simulator_.run(source, options, sink, progress), result.summary);
}

// Of the modules, in readouts that begin with the light; parts of a run have it once.
void EventSimulation::add_noise(const PlannedEvent& event, std::optional<std::size_t> emitter,
                                std::uint64_t stream, EventFileWriter& writer, EventResult& result) {
  if (usual_.shard.index != 1) return;
  NoiseWindow window;
  window.readouts = event.repeats;
  if (!event.truth.empty()) {
    const double start = std::ranges::min(event.truth, {}, &Particle::time).time;
    window.from += start, window.to += start;
  }
  const auto hits = noise_hits(simulator_.model(), window, emitter, usual_.seed, stream);
  write(hits, event.repeats, writer);
  const auto count = static_cast<double>(hits.size());
  result.summary.hits += hits.size();
  result.summary.weights += {hits.size(), count, count};
}

void EventSimulation::write(std::span<const SimulatedHit> hits, double repeats, EventFileWriter& writer) {
  std::vector<Hit> portion;
  for (const SimulatedHit& hit : hits) {
    portion.push_back(to_hit(hit, *simulator_.model().detector));
    portion.back().charge = static_cast<float>(portion.back().charge / repeats);
    modules_.insert(hit.module);
  }
  writer.append(portion);
}

}  // namespace floe

#include "reco/direct_fit/expectation_model.h"

#include <algorithm>
#include <utility>

#include "reco/pulse_delays.h"

namespace floe {

void fill(LightSample& sample, std::size_t modules, std::vector<std::pair<std::uint32_t, float>>&& hits) {
  std::sort(hits.begin(), hits.end());
  sample.first.assign(modules + 1, 0);
  sample.times.clear();
  sample.times.reserve(hits.size());
  for (const auto& [module, time] : hits) {
    ++sample.first[module + 1];
    sample.times.push_back(time);
  }
  for (std::size_t i = 0; i < modules; ++i) sample.first[i + 1] += sample.first[i];
}

SimulatedLight::SimulatedLight(Model model, CascadeKind kind, std::uint64_t seed, int threads,
                               std::vector<ExpectedDelay> delays)
    : model_(std::move(model)), kind_(kind), seed_(seed), threads_(threads), delays_(std::move(delays)) {}

const Simulator& SimulatedLight::simulator(double oversize) {
  auto& simulator = simulators_[oversize];
  if (!simulator) simulator = std::make_unique<Simulator>(model_, oversize);
  return *simulator;
}

double SimulatedLight::photons_per_cascade(const CascadeParameters& cascade, double oversize) {
  const CascadeSource source(to_cascade(cascade, kind_), model_.acceptance.spectrum);
  return simulator(oversize).photons_to_propagate(source);
}

LightSample SimulatedLight::sample(const LightRequest& request) {
  // Times are counted from the vertex, where single precision is best.
  Cascade cascade = to_cascade(request.cascade, kind_);
  cascade.time = 0;
  const CascadeSource source(cascade, model_.acceptance.spectrum);
  const Simulator& walker = simulator(request.oversize);

  LightSample result;
  result.cascade = request.cascade;
  result.oversize = request.oversize;
  result.repeats = request.photons / walker.photons_to_propagate(source);
  SimulationOptions options;
  options.seed = seed_;
  options.stream = request.stream;
  options.threads = threads_;
  options.scale = result.repeats;
  options.fixed_number = true;
  const PulseDelays delay(delays_, seed_, request.stream);
  std::vector<std::pair<std::uint32_t, float>> hits;
  const auto summary = walker.run(source, options, [&](std::span<const SimulatedHit> portion) {
    for (const SimulatedHit& hit : portion) hits.emplace_back(hit.module, hit.time + delay(hit));
  });
  result.propagated = summary.propagated;
  fill(result, model_.detector->size(), std::move(hits));
  return result;
}

}  // namespace floe

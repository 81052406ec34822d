#include "reco/diagnose/trial_light.h"

#include <fmt/format.h>

namespace floe {

namespace {

Eigen::VectorXd hits_in_bins(const std::vector<SimulatedHit>& hits, const RunBins& bins) {
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(bins.size());
  for (const SimulatedHit& hit : hits)
    if (const int bin = bins.bin(hit.module, hit.time); bin >= 0) counts(bin) += 1;
  return counts;
}

}  // namespace

RunRequest TrialLight::request(std::size_t run, std::uint64_t stream) const {
  const FlasherRun& flasher = runs_[run].run;
  return {flasher, flasher.photons, settings_.oversize, settings_.seed, stream + run, settings_.threads};
}

std::vector<SimulatedHit> TrialLight::hits_of(const Model& model, std::size_t run, std::uint64_t stream,
                                              double photons, const Survey* survey) const {
  RunRequest simulated = request(run, stream);
  simulated.photons = photons;
  if (survey) simulated.noise = noise_window(survey->runs[run].data, photons);
  return simulate_run(model, simulated).hits;
}

TrialLight::Hits TrialLight::hits(const Model& model, std::uint64_t stream, const Survey* survey) const {
  Hits hits;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    hits.push_back(hits_of(model, r, stream, runs_[r].run.photons, survey));
  return hits;
}

LightInBins TrialLight::in_bins(const Model& model, std::uint64_t stream, const Survey& survey) const {
  LightInBins light;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    light.push_back(
        hits_in_bins(hits_of(model, r, stream, survey.runs[r].photons, &survey), survey.runs[r].bins));
  return light;
}

FlasherData TrialLight::data_of(const Hits& hits) const {
  std::vector<Event> events;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& [run, repeats] = runs_[r];
    Event event;
    event.id = fmt::format("{},{}", run.module.string, run.module.dom);
    event.repeats = repeats;
    event.flasher = run;
    event.flasher->oversize = settings_.oversize;
    for (const SimulatedHit& hit : hits[r]) {
      event.hits.push_back(to_hit(hit, detector_));
      event.hits.back().charge = static_cast<float>(event.hits.back().charge / repeats);
    }
    events.push_back(std::move(event));
  }
  return flasher_data(detector_, events);
}

SurveyCounts TrialLight::counts_of(const Hits& hits, const Survey& survey) {
  SurveyCounts counts = measured_counts(survey);
  for (std::size_t r = 0; r < survey.runs.size(); ++r)
    counts[r].data = hits_in_bins(hits[r], survey.runs[r].bins);
  return counts;
}

}  // namespace floe

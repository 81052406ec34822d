#include "reco/diagnose/trial_light.h"

namespace floe {

RunRequest TrialLight::request(std::size_t run, std::uint64_t stream) const {
  return {runs_[run].run, runs_[run].photons(), settings_.oversize,
          settings_.seed, stream + run,         settings_.threads};
}

std::vector<SimulatedHit> TrialLight::hits_of(const Model& model, std::size_t run, std::uint64_t stream,
                                              double photons, const Survey* survey) const {
  RunRequest simulated = request(run, stream);
  simulated.photons = photons;
  // Noise of all flashes goes with the light of all.
  if (survey) simulated.noise = noise_window(survey->runs[run].data, runs_[run].photons());
  return simulate_run(model, simulated).hits;
}

TrialLight::Hits TrialLight::hits(const Model& model, std::uint64_t stream, const Survey* survey) const {
  Hits hits;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    hits.push_back(hits_of(model, r, stream, runs_[r].photons(), survey));
  return hits;
}

LightInBins TrialLight::in_bins(const Model& model, std::uint64_t stream, const Survey& survey) const {
  LightInBins light;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    light.push_back(survey.runs[r].bins.counts(hits_of(model, r, stream, survey.runs[r].photons, &survey)));
  return light;
}

FlasherData TrialLight::data_of(const Hits& hits) const {
  std::vector<Event> events;
  FlasherRunNames names;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& [run, repeats] = runs_[r];
    Event event;
    event.id = names.next(run.module);
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
  for (std::size_t r = 0; r < survey.runs.size(); ++r) counts[r].data = survey.runs[r].bins.counts(hits[r]);
  return counts;
}

}  // namespace floe

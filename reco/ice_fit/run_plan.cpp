#include "reco/ice_fit/run_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "data/base/error.h"
#include "reco/ice_fit/run_likelihood.h"

namespace floe {

namespace {

constexpr double scout_share = 0.1;    // of a run's light: where to put the bins
constexpr double first_photons = 3e8;  // N of the first look at a run
constexpr double saturation = 500;     // photoelectrons of a flash
constexpr double least_light = 0.1;    // of a run's charge

// The charge of the data less its dark noise.
double charge_of_light(const Model& model, const RunData& run) {
  const auto modules = static_cast<double>(std::ranges::count(run.used, char{1}));
  const double noise = (model.noise_rate + run.noise_rate) * seconds_per_nanosecond * (run.last - run.first) *
                       run.repeats * modules;
  return std::max(least_light * run.charge, run.charge - noise);
}

}  // namespace

FirstLook look_first(const Model& model, const RequestOfRun& request, FlasherData& data) {
  leave_out_bright_receivers(*model.detector, saturation, data);
  FirstLook look;
  std::vector<SimulatedRun> simulated;
  std::vector<std::vector<double>> expected;
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    const RunData& run = data.runs[r];
    simulated.push_back(simulate_run(model, request(r, first_photons)));
    look.propagated += simulated.back().propagated;
    const double hits = std::max(1.0, used_hits(simulated.back(), run));
    expected.emplace_back(run.used.size(), 0.0);
    for (const SimulatedHit& hit : simulated.back().hits) expected.back()[hit.module] += run.charge / hits;
  }
  leave_out_bad_receivers(*model.detector, expected, saturation, data);
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    look.hits_per_photon.push_back(std::max(1.0, used_hits(simulated[r], data.runs[r])) / first_photons);
    look.brightness.push_back(charge_of_light(model, data.runs[r]) / look.hits_per_photon.back());
  }
  return look;
}

void leave_out_run(std::size_t run, const std::string& why, FlasherData& data, FirstLook& look) {
  data.left_out.push_back(fmt::format("run {}: {}", data.runs[run].name, why));
  const auto at = static_cast<std::ptrdiff_t>(run);
  data.runs.erase(data.runs.begin() + at);
  look.hits_per_photon.erase(look.hits_per_photon.begin() + at);
  look.brightness.erase(look.brightness.begin() + at);
}

void leave_out_dark_runs(FlasherData& data, FirstLook& look) {
  for (std::size_t r = data.runs.size(); r-- > 0;)
    if (!(data.runs[r].charge > 0))
      leave_out_run(r, "no receiver is left that could be compared", data, look);
  if (data.runs.empty())
    throw NoResult("not enough light: no flasher run has a receiver that could be compared");
}

void check(const RunSettings& settings) {
  const auto require = [](bool right, const char* what) {
    if (!right) throw UsageError(what);
  };
  require(settings.oversize >= 1 && settings.oversize <= 100,
          "the oversize factor must be between 1 and 100");
  require(settings.light.light > 0, "the simulated light must be more than none of the data's");
  require(settings.model_error >= 0 && settings.model_error <= 1, "the model error must be between 0 and 1");
}

double photons_wanted(const RunData& run, double hits_per_photon, const LightBudget& budget) {
  const double hits = std::max(budget.least_hits, budget.light * run.charge);
  return std::min(budget.most_photons, hits / hits_per_photon);
}

NoiseWindow noise_window(const RunData& run, double brightness) {
  return {run.first, run.last, brightness > 0 ? run.repeats / brightness : 0, run.noise_rate};
}

RunRequest request_of(const RunData& run, const RunSettings& settings, double photons, std::uint64_t stream,
                      double brightness) {
  return {run.run,
          photons,
          settings.oversize,
          settings.seed,
          stream,
          settings.threads,
          noise_window(run, brightness),
          run.afterpulses,
          run.delays};
}

Scout scout_run(const Model& model, RunRequest request, double time_zero) {
  request.photons *= scout_share;
  Scout scout{simulate_run(model, request), request.photons};
  delay(scout.simulated, time_zero);
  return scout;
}

RunBins bins_of(const Scout& scout, const RunData& run, double brightness) {
  std::vector<SimulatedHit> light;
  std::ranges::copy_if(scout.simulated.hits, std::back_inserter(light), has_path);
  return RunBins(light, brightness / scout.photons, run.used, {});
}

RunView view_run(const Model& model, const RunRequest& request, const RunData& run, double brightness,
                 double model_error) {
  constexpr double settled_time = 5;  // [ns]; bins that are less late are as good
  constexpr int most_searches = 5;
  Scout scout = scout_run(model, request, 0);
  double time_zero = 0, shift = 2 * settled_time;
  for (int i = 0; i < most_searches && std::abs(shift) > settled_time; ++i) {
    shift = measure_run(scout.simulated, scout.photons, run, bins_of(scout, run, brightness), {brightness, 0},
                        model_error)
                .nuisances.time_zero;
    delay(scout.simulated, shift);
    time_zero += shift;
  }
  return {bins_of(scout, run, brightness), time_zero, scout.simulated.propagated};
}

}  // namespace floe

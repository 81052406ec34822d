#include "reco/ice_fit/run_scores.h"

#include <algorithm>
#include <cmath>

#include "reco/ice_fit/run_likelihood.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

namespace {

// Far from the streams of simulated data.
constexpr std::uint64_t first_stream = std::uint64_t{1} << 40;
constexpr std::uint64_t streams_a_run = 1 << 10, streams_a_round = 1 << 20;

// Hits with the run's time zero.
SimulatedRun simulate(const Model& model, const RunRequest& request, double time_zero) {
  SimulatedRun run = simulate_run(model, request);
  delay(run, time_zero);
  return run;
}

}  // namespace

RunScores::RunScores(FlasherData data, const IceFitOptions& options)
    : data_(std::move(data)), options_(options), states_(data_.runs.size()) {}

RunRequest RunScores::request(std::size_t r, std::uint64_t purpose, double photons) const {
  return request_of(
      data_.runs[r], options_, photons,
      first_stream + static_cast<std::uint64_t>(round_) * streams_a_round + r * streams_a_run + purpose,
      states_[r].brightness);
}

void RunScores::look_first(const Model& model, bool runs_keep_numbers) {
  FirstLook look = floe::look_first(
      model, [this](std::size_t r, double photons) { return request(r, 0, photons); }, data_);
  propagated_ += look.propagated;
  if (!runs_keep_numbers) leave_out_dark_runs(data_, look);
  states_.resize(data_.runs.size());
  for (std::size_t r = 0; r < states_.size(); ++r) {
    states_[r].hits_per_photon = look.hits_per_photon[r];
    states_[r].brightness = look.brightness[r];
  }
}

double RunScores::photons_of(std::size_t r) const {
  return photons_wanted(data_.runs[r], states_[r].hits_per_photon, options_.light);
}

RunBins RunScores::bins_of(const Model& model, std::size_t r) {
  const Scout scout = scout_run(model, request(r, 1, photons_of(r)), states_[r].time_zero);
  propagated_ += scout.simulated.propagated;
  return floe::bins_of(scout, data_.runs[r], states_[r].brightness);
}

void RunScores::begin_round(const Model& model) {
  ++round_;
  if (round_ <= 2)
    for (std::size_t r = 0; r < count(); ++r) states_[r].bins = bins_of(model, r);
}

EfficiencyColumns RunScores::efficiency_columns(int first) const {
  if (options_.efficiency_width == 0) return {};
  std::vector<const RunBins*> bins;
  for (const State& state : states_) bins.push_back(&state.bins);
  return {bins, first};
}

void RunScores::add(const IcePoint& point, std::size_t r, std::size_t parameters,
                    const EfficiencyColumns& efficiencies, ScoreSystem& system) {
  const RunData& run = data_.runs[r];
  State& state = states_[r];
  const double photons = (round_ == 1 ? options_.first_light : options_.later_light) * photons_of(r);
  const RunBins& bins = state.bins;
  const RunRequest request = this->request(r, 2, photons);
  const SimulatedRun simulated = simulate(point.model(), request, state.time_zero);
  auto [light, propagated] =
      point.light(request, simulated, bins, state.time_zero,
                  {.light = options_.pair_light, .least_hits = options_.least_pair_hits});
  propagated_ += simulated.propagated + propagated;

  const double hits = used_hits(simulated, run);
  state.hits_per_photon = std::max(1.0, hits) / photons;
  RunCounts counts;
  counts.data = run.counts(bins);
  counts.scale = state.brightness / light.photons;
  counts.dispersion = dispersion(simulated);
  counts.data_dispersion = (run.run.oversize > 1 ? counts.dispersion : 1) * run.charge_dispersion;
  counts.model_error = options_.model_error;
  RunColumns columns{static_cast<int>(parameters + 2 * r), efficiencies.of_receivers(bins), {}};
  if (efficiencies.count() > 0) columns.receiver_of_bin = bins.receiver_of_bin();
  if (round_ <= 2) {
    add_run(light, light, counts, columns, system);
    state.seen = std::move(light);
  } else {
    add_run(light, state.seen, counts, columns, system);
    for (int fold = 0; fold < 2; ++fold) state.seen.folds[fold] += light.folds[fold];
  }
}

bool RunScores::is_short(const Eigen::VectorXd& step, std::size_t parameters) const {
  constexpr double brightness = 0.1, time_zero = 2;  // in the logarithm; [ns]
  for (std::size_t r = 0; r < count(); ++r) {
    const auto i = static_cast<Eigen::Index>(parameters + 2 * r);
    if (std::abs(step(i)) > brightness || std::abs(step(i + 1)) > time_zero) return false;
  }
  return true;
}

void RunScores::step_nuisances(const Eigen::VectorXd& step, std::size_t parameters) {
  for (std::size_t r = 0; r < count(); ++r) {
    const auto i = static_cast<Eigen::Index>(parameters + 2 * r);
    states_[r].brightness *= std::exp(step(i));
    states_[r].time_zero += step(i + 1);
  }
}

RunResult RunScores::judge(const Model& model, std::size_t r) {
  const RunData& run = data_.runs[r];
  const RunBins bins = bins_of(model, r);
  const double photons = photons_of(r);
  const SimulatedRun simulated = simulate(model, request(r, 2, photons), states_[r].time_zero);
  propagated_ += simulated.propagated;
  // Its hits have the time zero already.
  const RunMeasurement measured =
      measure_run(simulated, photons, run, bins, {states_[r].brightness, 0}, options_.model_error);
  return {run.name, measured.nuisances.brightness / run.repeats,
          states_[r].time_zero + measured.nuisances.time_zero, measured.neg_llh, measured.bins};
}

}  // namespace floe

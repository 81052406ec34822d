#include "reco/ice_fit/model_judge.h"

#include <numeric>
#include <random>
#include <vector>

#include "propagation/engine/threads.h"
#include "reco/ice_fit/photon_draws.h"

namespace floe {

namespace {

// For the expectation, whose error is a tenth of one measurement's scatter; that of the scatter is 7%.
constexpr int draws = 100;

}  // namespace

double variance_of_difference(Eigen::Index bins, double light) {
  const double of_data = light / (1 + light);
  return static_cast<double>(bins) * (1 - of_data * of_data);
}

ModelJudge::ModelJudge(const Model& base, const FlasherData& data, const FirstLook& look,
                       const RunSettings& settings, std::uint64_t stream)
    : data_(data), settings_(settings), stream_(stream), brightness_(look.brightness) {
  for (std::size_t r = 0; r < data_.runs.size(); ++r) {
    const RunData& run = data_.runs[r];
    photons_.push_back(photons_wanted(run, look.hits_per_photon[r], settings_.light));
    views_.push_back(
        view_run(base, request(r, 0, photons_[r]), run, look.brightness[r], settings_.model_error));
    squared_noise_ +=
        variance_of_difference(views_[r].bins.size(), photons_[r] * look.hits_per_photon[r] / run.charge);
  }
}

RunRequest ModelJudge::request(std::size_t run, std::uint64_t purpose, double photons) const {
  return request_of(data_.runs[run], settings_, photons, stream_ + purpose * data_.runs.size() + run,
                    brightness_[run]);
}

RunMeasurement ModelJudge::measured(const SimulatedRun& simulated, std::size_t run) const {
  return measure_run_finely(simulated, photons_[run], data_.runs[run], views_[run].bins,
                            {0, views_[run].time_zero}, settings_.model_error);
}

RunMeasurement ModelJudge::measure(const Model& model, std::size_t run) const {
  return measured(simulate_run(model, request(run, 1, photons_[run])), run);
}

double ModelJudge::neg_llh(const Model& model) const {
  double sum = 0;
  for (std::size_t r = 0; r < data_.runs.size(); ++r) sum += measure(model, r).neg_llh;
  return sum;
}

ModelJudge::Fit ModelJudge::judge(const Model& model, std::size_t run) const {
  SimulatedRun simulated = simulate_run(model, request(run, 1, photons_[run]));
  Fit fit;
  fit.measured = measured(simulated, run);
  delay(simulated, fit.measured.nuisances.time_zero);
  const double factor = dispersion(simulated), brightness = fit.measured.nuisances.brightness;
  const PhotonDraws pseudo(simulated, views_[run].bins, brightness / photons_[run],
                           data_.runs[run].run.oversize > 1, data_.runs[run].charge_dispersion,
                           settings_.model_error);
  std::vector<double> drawn(draws);
  const int threads = thread_count(settings_.threads);
#pragma omp parallel for num_threads(threads)
  for (int d = 0; d < draws; ++d) {
    const std::uint64_t stream = (stream_ + run) * draws + static_cast<std::uint64_t>(d);
    std::seed_seq sequence{settings_.seed, settings_.seed >> 32, stream, stream >> 32};
    std::mt19937_64 random(sequence);
    const FoldedCounts counts = pseudo.draw(random);
    const Eigen::VectorXd simulated_counts = (counts.simulated[0] + counts.simulated[1]) / factor;
    drawn[static_cast<std::size_t>(d)] =
        measure_counts({counts.data, simulated_counts, photons_[run] / factor}, brightness,
                       settings_.model_error)
            .neg_llh;
  }
  fit.expected = std::accumulate(drawn.begin(), drawn.end(), 0.0) / draws;
  double squares = 0;
  for (const double value : drawn) squares += std::pow(value - fit.expected, 2);
  fit.scatter = std::sqrt(squares / (draws - 1));
  return fit;
}

std::vector<ModelJudge::Fit> ModelJudge::judge_all(const Model& model) const {
  std::vector<Fit> fits;
  for (std::size_t r = 0; r < data_.runs.size(); ++r) fits.push_back(judge(model, r));
  return fits;
}

}  // namespace floe

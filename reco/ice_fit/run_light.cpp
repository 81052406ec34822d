#include "reco/ice_fit/run_light.h"

#include <algorithm>
#include <array>

#include "propagation/engine/threads.h"
#include "propagation/sources/flasher.h"
#include "reco/ice_fit/smooth_slopes.h"
#include "reco/pulse_delays.h"
#include "response/afterpulses.h"

namespace floe {

namespace {

constexpr double slope_step = 2;  // [ns] each way, for the slope in time zero
constexpr std::uint64_t first_afterpulse = first_noise_hit + (std::uint64_t{1} << 61);
constexpr std::size_t parts = 16;  // of the work: sums come out alike for any number of threads

FlasherSource source_of(const Model& model, const RunRequest& request) {
  FlasherRun run = request.run;
  run.photons = request.photons;
  const WavelengthSpectrum line =
      run.wavelength == FlasherRun{}.wavelength ? reference_led_line() : led_line(run.wavelength);
  return {*model.detector, run.module, adjusted(flasher_settings(run), model.sources), line};
}

LightFold empty_fold(int bins, int parameters) {
  return {Eigen::VectorXd::Zero(bins), Eigen::MatrixXd::Zero(bins, parameters),
          Eigen::MatrixXd::Zero(bins, parameters), Eigen::MatrixXd::Zero(bins, parameters),
          Eigen::VectorXd::Zero(bins)};
}

// They follow hits, but are like noise in that no path leads to them.
void add_afterpulses(const RunRequest& request, SimulatedRun& run) {
  if (!(request.afterpulses.share > 0)) return;
  RandomStream random(request.seed, request.stream, first_afterpulse);
  const std::size_t light = run.hits.size();
  for (std::size_t i = 0; i < light; ++i) {
    if (random.uniform() >= request.afterpulses.share) continue;
    SimulatedHit hit = run.hits[i];
    hit.time += static_cast<float>(draw_afterpulse_delay(request.afterpulses, random));
    hit.photon = first_afterpulse + i;
    run.hits.push_back(hit);
  }
}

}  // namespace

LightFold& LightFold::operator+=(const LightFold& other) {
  counts += other.counts;
  slopes += other.slopes;
  slope_squares += other.slope_squares;
  dwell += other.dwell;
  delay += other.delay;
  return *this;
}

SimulatedRun simulate_run(const Model& model, const RunRequest& request) {
  const FlasherSource source = source_of(model, request);
  const Simulator simulator(model, request.oversize);
  SimulationOptions options;
  options.seed = request.seed;
  options.stream = request.stream;
  options.threads = request.threads;
  options.fixed_number = true;
  SimulatedRun run;
  run.propagated = simulator
                       .run(source, options,
                            [&](std::span<const SimulatedHit> hits) {
                              run.hits.insert(run.hits.end(), hits.begin(), hits.end());
                            })
                       .propagated;
  const PulseDelays delay_of(request.delays, request.seed, request.stream);
  for (SimulatedHit& hit : run.hits) hit.time += delay_of(hit);
  add_afterpulses(request, run);
  NoiseWindow noise = request.noise;
  noise.readouts *= request.photons;
  const auto hits = noise_hits(model, noise, source.emitting_module(), request.seed, request.stream);
  run.hits.insert(run.hits.end(), hits.begin(), hits.end());
  return run;
}

RunLight count_light(const SimulatedRun& run, const RunBins& bins, double photons, int parameters) {
  RunLight light;
  light.photons = photons / 2;
  light.symmetric.assign(static_cast<std::size_t>(parameters), 1);
  light.independent.assign(static_cast<std::size_t>(parameters), 0);
  for (LightFold& fold : light.folds) fold = empty_fold(bins.size(), parameters);
  for (const SimulatedHit& hit : run.hits) {
    const int bin = bins.bin(hit.module, hit.time);
    if (bin < 0) continue;
    LightFold& fold = light.folds[hit.photon & 1];
    fold.counts(bin) += 1;
    fold.delay(bins.bin(hit.module, hit.time + slope_step)) += 1 / (2 * slope_step);
    fold.delay(bins.bin(hit.module, hit.time - slope_step)) -= 1 / (2 * slope_step);
  }
  return light;
}

RunLight light_with_slopes(const Model& model, const RunRequest& request, const SimulatedRun& run,
                           const RunBins& bins, const ScoreMap& map, double time_zero) {
  RunLight light = count_light(run, bins, request.photons, map.parameters());
  for (int p = 0; p < map.parameters(); ++p)
    light.symmetric[static_cast<std::size_t>(p)] = map.is_symmetric(p);
  std::vector<std::uint64_t> photons;
  for (const SimulatedHit& hit : run.hits)
    if (has_path(hit) && (photons.empty() || photons.back() != hit.photon) &&
        bins.bin(hit.module, hit.time) >= 0)
      photons.push_back(hit.photon);
  const Vec3 flasher = model.detector->modules()[model.detector->index_of(request.run.module)].position;
  light.places = bin_places(bins, *model.detector, flasher, model.ice->flow_azimuth());
  const FlasherSource source = source_of(model, request);
  const auto tracer = make_path_tracer(model, request.oversize);
  const PulseDelays delay_of(request.delays, request.seed, request.stream);
  const int threads = thread_count(request.threads);
  const std::size_t share = (photons.size() + parts - 1) / parts;
  std::vector<std::array<LightFold, 2>> sums(parts);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t first = std::min(part * share, photons.size());
    const std::span<const std::uint64_t> some(photons.data() + first,
                                              std::min(share, photons.size() - first));
    for (LightFold& fold : sums[part]) fold = empty_fold(bins.size(), map.parameters());
    Eigen::VectorXd scores, dwell;
    tracer->trace(source, request.seed, request.stream, some,
                  [&](const SimulatedHit& hit, const PathScores& path) {
                    const int bin = bins.bin(hit.module, hit.time + delay_of(hit) + time_zero);
                    if (bin < 0) return;
                    map.scores(path, scores, dwell);
                    LightFold& fold = sums[part][hit.photon & 1];
                    fold.slopes.row(bin) += scores;
                    fold.slope_squares.row(bin) += scores.cwiseAbs2();
                    fold.dwell.row(bin) += dwell;
                  });
  }
  for (const auto& part : sums)
    for (std::size_t fold = 0; fold < 2; ++fold) light.folds[fold] += part[fold];
  return light;
}

}  // namespace floe

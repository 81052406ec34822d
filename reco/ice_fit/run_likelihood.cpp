#include "reco/ice_fit/run_likelihood.h"

#include <algorithm>
#include <cmath>

#include "reco/likelihood/limited_simulation.h"

namespace floe {

namespace {

constexpr double time_step = 1, finest_step = 0.125;  // [ns]
constexpr int most_steps = 20;

// At one brightness: value, slope and curvature in its logarithm.
BinLikelihood sum_at(const ComparedCounts& counts, double brightness, double model_error) {
  BinLikelihood sum;
  for (Eigen::Index b = 0; b < counts.data.size(); ++b) {
    const BinLikelihood bin =
        limited_simulation({counts.data(b), brightness, counts.simulated(b), counts.photons}, model_error);
    sum.value += bin.value;
    sum.slope += bin.slope;
    sum.curvature += bin.curvature;
  }
  return sum;
}

// Newton's way; the sum is convex in the logarithm of brightness.
double best_brightness(const ComparedCounts& counts, double brightness, double model_error) {
  for (int i = 0; i < most_steps; ++i) {
    const BinLikelihood at = sum_at(counts, brightness, model_error);
    if (!(at.curvature > 0)) break;
    const double step = std::clamp(-at.slope / at.curvature, -1.0, 1.0);
    brightness *= std::exp(step);
    if (std::abs(step) < 1e-6) break;
  }
  return brightness;
}

// Of a run with one simulation, at any time zero.
class Comparison {
 public:
  Comparison(const SimulatedRun& simulated, double photons, const RunData& run, const RunBins& bins,
             double brightness, double model_error)
      : simulated_(simulated),
        bins_(bins),
        data_(run.counts(bins)),
        dispersion_(dispersion(simulated)),
        photons_(photons),
        brightness_(brightness > 0 ? brightness
                                   : run.charge * photons / std::max(1.0, used_hits(simulated, run))),
        model_error_(model_error) {}

  RunMeasurement at(double time_zero) const {
    RunMeasurement measured = measure_counts(
        {data_, bins_.counts(simulated_.hits, time_zero) / dispersion_, photons_ / dispersion_}, brightness_,
        model_error_);
    measured.nuisances.time_zero = time_zero;
    return measured;
  }

 private:
  const SimulatedRun& simulated_;
  const RunBins& bins_;
  Eigen::VectorXd data_;
  double dispersion_, photons_, brightness_, model_error_;
};

}  // namespace

double used_hits(const SimulatedRun& simulated, const RunData& run) {
  return static_cast<double>(
      std::count_if(simulated.hits.begin(), simulated.hits.end(),
                    [&](const SimulatedHit& hit) { return run.used[hit.module] != 0; }));
}

double dispersion(const SimulatedRun& simulated) {
  double square = 0;
  for (std::size_t i = 0; i < simulated.hits.size();) {
    std::size_t k = i;
    while (k < simulated.hits.size() && simulated.hits[k].photon == simulated.hits[i].photon) ++k;
    square += static_cast<double>((k - i) * (k - i));
    i = k;
  }
  return simulated.hits.empty() ? 1 : square / static_cast<double>(simulated.hits.size());
}

void delay(SimulatedRun& simulated, double time) {
  for (SimulatedHit& hit : simulated.hits) hit.time += static_cast<float>(time);
}

RunMeasurement measure_counts(const ComparedCounts& counts, double brightness, double model_error) {
  const double best = best_brightness(counts, brightness, model_error);
  return {sum_at(counts, best, model_error).value, {best, 0}, static_cast<int>(counts.data.size())};
}

RunMeasurement measure_run(const SimulatedRun& simulated, double photons, const RunData& run,
                           const RunBins& bins, const RunNuisances& start, double model_error) {
  const Comparison compared(simulated, photons, run, bins, start.brightness, model_error);
  // Downhill in steps of the time.
  RunMeasurement best = compared.at(start.time_zero);
  for (const double way : {time_step, -time_step})
    for (int i = 0; i < most_steps; ++i) {
      const RunMeasurement next = compared.at(best.nuisances.time_zero + way);
      if (next.neg_llh >= best.neg_llh) break;
      best = next;
    }
  return best;
}

RunMeasurement measure_run_finely(const SimulatedRun& simulated, double photons, const RunData& run,
                                  const RunBins& bins, const RunNuisances& start, double model_error) {
  const Comparison compared(simulated, photons, run, bins, start.brightness, model_error);
  RunMeasurement best = measure_run(simulated, photons, run, bins, start, model_error);
  for (double step = time_step / 2; step >= finest_step; step /= 2) {
    const double middle = best.nuisances.time_zero;
    for (const double way : {step, -step}) {
      const RunMeasurement next = compared.at(middle + way);
      if (next.neg_llh < best.neg_llh) best = next;
    }
  }
  return best;
}

}  // namespace floe

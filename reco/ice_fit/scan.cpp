#include "reco/ice_fit/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "data/base/error.h"
#include "reco/ice_fit/run_light.h"
#include "reco/ice_fit/run_likelihood.h"

namespace floe {

namespace {

// Streams of scans are far from those that data are simulated with.
constexpr std::uint64_t first_stream = std::uint64_t{1} << 40, streams_a_run = 1 << 10;
enum Purpose : std::uint64_t { look_stream, bins_stream, grid_stream };

void check(const ScanAxis& axis) {
  const IceParameter& p = axis.parameter;
  const double low = p.logarithmic ? std::exp(p.low) : p.low,
               high = p.logarithmic ? std::exp(p.high) : p.high;
  const auto require = [&](bool right, const std::string& what) {
    if (!right) throw UsageError(fmt::format("{}: {}", p.name, what));
  };
  require(axis.count >= 3, fmt::format("found {} values; a landscape needs 3", axis.count));
  require(axis.low < axis.high,
          fmt::format("found the range {:g} to {:g}; expected the lower value first", axis.low, axis.high));
  const double slack = 1e-9 * (high - low);  // exponentials of logarithms are not exact
  require(axis.low >= low - slack && axis.high <= high + slack,
          fmt::format("found the range {:g} to {:g}; expected values from {:g} to {:g}", axis.low, axis.high,
                      low, high));
}

void check(const ScanAxis& x, const ScanAxis& y, const RunSettings& options) {
  check(x);
  check(y);
  if (x.parameter.name == y.parameter.name)
    throw UsageError(fmt::format("{} is named twice", x.parameter.name));
  check(options);
}

// Even or odd photons.
SimulatedRun half_of(const SimulatedRun& run, std::uint64_t parity) {
  SimulatedRun half;
  for (const SimulatedHit& hit : run.hits)
    if ((hit.photon & 1) == parity) half.hits.push_back(hit);
  return half;
}

// What is the same of a run at all points.
struct RunPlan {
  std::size_t run;  // in the data
  double photons;   // N of a simulation
  RunBins bins;
  RunNuisances start;
};

class Scan {
 public:
  Scan(const Model& base, const FlasherData& data, const RunSettings& options, const Progress& progress,
       IceScan& result)
      : base_(base), data_(data), options_(options), progress_(progress), scan_(result) {}

  void run() {
    plan_runs();
    const auto xs = scan_.x.values(), ys = scan_.y.values();
    scan_.neg_llh = {scan_.y.count, scan_.x.count, {}};
    for (const double y : ys)
      for (const double x : xs) measure_point(x, y);
    scan_.noise = noise(quadratic_minimum(xs, ys, scan_.neg_llh).points);
    scan_.minimum = quadratic_minimum(xs, ys, scan_.neg_llh, scan_.noise);
  }

 private:
  RunRequest request(std::size_t r, Purpose purpose, double photons, double brightness = 0) const {
    return request_of(data_.runs[r], options_, photons, first_stream + r * streams_a_run + purpose,
                      brightness);
  }

  void plan_runs() {
    report(0, "looking at the runs");
    const FirstLook look = look_first(
        base_, [this](std::size_t r, double photons) { return request(r, look_stream, photons); }, data_);
    scan_.photons += look.propagated;
    scan_.left_out = data_.left_out;
    for (std::size_t r = 0; r < data_.runs.size(); ++r) {
      RunPlan plan = plan_run(r, look);
      if (plan.bins.size() > 0) {
        scan_.bins += plan.bins.size();
        plans_.push_back(std::move(plan));
      } else {
        scan_.left_out.push_back(fmt::format("run {}: not enough light on any receiver", data_.runs[r].name));
      }
    }
    if (plans_.empty())
      throw NoResult("not enough light: no flasher run has a receiver that could be compared");
  }

  RunPlan plan_run(std::size_t r, const FirstLook& look) {
    const RunData& run = data_.runs[r];
    const double photons = photons_wanted(run, look.hits_per_photon[r], options_.light),
                 brightness = look.brightness[r];
    RunView view =
        view_run(base_, request(r, bins_stream, photons, brightness), run, brightness, options_.model_error);
    scan_.photons += view.propagated;
    return {r, photons, std::move(view.bins), {brightness, view.time_zero}};
  }

  void measure_point(double x, double y) {
    report(static_cast<double>(scan_.neg_llh.values.size()) / (scan_.x.count * scan_.y.count),
           fmt::format("{} {:.4g}, {} {:.4g}", scan_.x.parameter.name, x, scan_.y.parameter.name, y));
    const Model model = with_parameters(base_, {scan_.x.parameter, scan_.y.parameter},
                                        {scan_.x.number(x), scan_.y.number(y)});
    std::vector<RunResult> results;
    double sum = 0, halves = 0;
    for (const RunPlan& plan : plans_) {
      const SimulatedRun simulated =
          simulate_run(model, request(plan.run, grid_stream, plan.photons, plan.start.brightness));
      scan_.photons += simulated.propagated;
      const RunMeasurement best = measure_run_finely(simulated, plan.photons, data_.runs[plan.run], plan.bins,
                                                     plan.start, options_.model_error);
      sum += best.neg_llh;
      halves += difference_of_halves(simulated, plan, best);
      const RunData& run = data_.runs[plan.run];
      results.push_back({run.name, best.nuisances.brightness / run.repeats, best.nuisances.time_zero,
                         best.neg_llh, best.bins});
    }
    const std::vector<double>& sums = scan_.neg_llh.values;
    if (sums.empty() || sum < *std::min_element(sums.begin(), sums.end())) scan_.runs = results;
    scan_.neg_llh.values.push_back(sum);
    half_differences_.push_back(halves);
  }

  // The likelihood heeds simulation the less the less there is of it: a deviation counts 1/(1 + 1/r), r being
  // the simulation's light in units of the data's. What halves differ by is put right for that.
  double difference_of_halves(const SimulatedRun& simulated, const RunPlan& plan,
                              const RunMeasurement& whole) const {
    double neg_llh[2];
    for (const std::uint64_t parity : {0, 1})
      neg_llh[parity] = measure_run(half_of(simulated, parity), plan.photons / 2, data_.runs[plan.run],
                                    plan.bins, whole.nuisances, options_.model_error)
                            .neg_llh;
    const double r = plan.photons / (dispersion(simulated) * whole.nuisances.brightness);
    return (r + 2) / (r + 1) * (neg_llh[0] - neg_llh[1]);
  }

  // Halves are independent: half of what they differ by scatters as what they have in common, their mean,
  // does. Differences of two points scatter sqrt(2) times as much as points about their mean.
  double noise(const std::vector<std::size_t>& points) const {
    if (points.size() < 2) return 0;
    const auto n = static_cast<double>(points.size());
    double mean = 0, squares = 0;
    for (const std::size_t i : points) mean += half_differences_[i] / 2 / n;
    for (const std::size_t i : points) squares += std::pow(half_differences_[i] / 2 - mean, 2);
    return std::sqrt(2 * squares / (n - 1));
  }

  void report(double fraction, const std::string& what) const {
    if (progress_) progress_(fraction, what);
  }

  const Model& base_;
  FlasherData data_;
  const RunSettings& options_;
  const Progress& progress_;
  IceScan& scan_;
  std::vector<RunPlan> plans_;
  std::vector<double> half_differences_;  // by point: -ln L of even photons less that of odd ones
};

}  // namespace

std::vector<double> ScanAxis::values() const {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(i + 1 < count ? low + i * step() : high);
  return values;
}

double ScanAxis::base() const {
  return parameter.logarithmic ? std::exp(parameter.start) : parameter.start;
}

double ScanAxis::number(double value) const {
  return parameter.logarithmic ? std::log(value) : value;
}

IceScan scan_ice(const Model& base, const FlasherData& data, const ScanAxis& x, const ScanAxis& y,
                 const RunSettings& options, const Progress& progress) {
  check(x, y, options);
  const auto start = std::chrono::steady_clock::now();
  IceScan scan;
  scan.x = x;
  scan.y = y;
  Scan(base, data, options, progress, scan).run();
  scan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return scan;
}

}  // namespace floe

#include "reco/direct_fit/goodness_of_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace floe {
namespace {

// Inner edges of a module's bins become outer ones here: for noise, the first and last bin are finite.
double width(const EventData& data, const ModuleData& lit, std::size_t bin) {
  const double low = bin == 0 ? data.first_time() - EventData::margin : lit.edges[bin - 1];
  const double high = bin < lit.edges.size() ? lit.edges[bin] : data.last_time() + EventData::margin;
  return std::max(0.0, high - low);
}

}  // namespace

std::vector<BinCounts> count_bins(const EventData& data, const LightSample& sample, double time,
                                  double noise_rate) {
  const double noise = noise_rate * 1e-9 * sample.repeats;  // counts of the simulation per ns
  std::vector<BinCounts> bins;
  bins.reserve(data.bins());
  for (const ModuleData& lit : data.lit()) {
    const float* from = sample.begin(lit.module);
    for (std::size_t b = 0; b < lit.counts.size(); ++b) {
      const float* to = sample.end(lit.module);
      if (b < lit.edges.size()) to = std::lower_bound(from, to, static_cast<float>(lit.edges[b] - time));
      bins.push_back(
          {lit.counts[b], data.repeats(), double(to - from) + noise * width(data, lit, b), sample.repeats});
      from = to;
    }
  }
  const double window = data.last_time() - data.first_time() + 2 * EventData::margin;
  for (const std::uint32_t dark : data.dark())
    bins.push_back({0, data.repeats(), double(sample.count(dark)) + noise * window, sample.repeats});
  return bins;
}

double neg_llh(std::span<const BinCounts> bins, double model_error) {
  double sum = 0;
  for (const BinCounts& bin : bins) sum += limited_simulation(bin, model_error).value;
  return sum;
}

double Evaluation::mean_neg_llh() const {
  return std::accumulate(neg_llh.begin(), neg_llh.end(), 0.0) / double(neg_llh.size());
}

double Evaluation::error() const {
  const double n = double(neg_llh.size()), centre = mean_neg_llh();
  if (n < 2) return 0;
  double square = 0;
  for (const double value : neg_llh) square += (value - centre) * (value - centre);
  return std::sqrt(square / (n * (n - 1)));
}

Evaluation evaluate_cascade(ExpectationModel& light, const EventData& data, const CascadeParameters& cascade,
                            double photons, double oversize, int repeats, std::uint64_t stream,
                            double model_error, double noise_rate) {
  Evaluation result;
  for (int i = 0; i < repeats; ++i) {
    result.samples.push_back(
        light.sample({cascade, photons, oversize, stream + static_cast<std::uint64_t>(i)}));
    const std::vector<BinCounts> bins = count_bins(data, result.samples.back(), cascade.time, noise_rate);
    result.neg_llh.push_back(floe::neg_llh(bins, model_error));
    if (i == 0) result.mean.resize(bins.size(), {0, data.repeats(), 0, 0});
    for (std::size_t b = 0; b < bins.size(); ++b) {
      result.mean[b].data = bins[b].data;
      result.mean[b].simulation += bins[b].simulation / repeats;
      result.mean[b].simulation_events += bins[b].simulation_events / repeats;
    }
  }
  return result;
}

PseudoLikelihood draw_pseudo_data(std::span<const BinCounts> bins, double model_error, std::uint64_t seed,
                                  int draws) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss(0, model_error);
  double sum = 0, square = 0;
  for (int i = 0; i < draws; ++i) {
    double value = 0;
    for (const BinCounts& bin : bins) {
      if (bin.simulation <= 0) continue;
      const double rate = bin.simulation / bin.simulation_events;
      const double error = model_error > 0 ? gauss(random) : 0;
      BinCounts drawn = bin;
      drawn.simulation = double(std::poisson_distribution<long>(bin.simulation)(random));
      drawn.data = double(std::poisson_distribution<long>(rate * std::exp(error) * bin.data_events)(random));
      value += limited_simulation(drawn, model_error).value;
    }
    sum += value;
    square += value * value;
  }
  const double mean = sum / draws;
  return {mean, std::sqrt(std::max(0.0, square / draws - mean * mean) * draws / (draws - 1.0))};
}

}  // namespace floe

#include "reco/direct_fit/goodness_of_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace floe {
namespace {

// Adds the simulation of `part`, `sign` times.
void add(std::vector<BinOfData>& bins, std::span<const BinOfData> part, double sign) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].simulation = std::max(0.0, bins[i].simulation + sign * part[i].simulation);
    bins[i].simulation_events += sign * part[i].simulation_events;
  }
}

// A bin's counts dealt out again, as charges that scatter.
BinOfData redeal(const BinOfData& bin, double model_error, double charge_dispersion,
                 std::mt19937_64& random) {
  constexpr double least_charge = 0.05;
  const auto all = static_cast<long>(std::lround(bin.data + bin.simulation));
  if (all == 0 || bin.saturated || bin.left_out) return bin;
  const double odds = bin.data_events / bin.simulation_events *
                      std::exp(model_error * std::normal_distribution<double>()(random));
  BinOfData result = bin;
  result.data = double(std::binomial_distribution<long>(all, odds / (1 + odds))(random));
  result.simulation = double(all) - result.data;
  if (charge_dispersion > 1 && result.data > 0)
    result.data = std::max(least_charge, result.data + std::sqrt((charge_dispersion - 1) * result.data) *
                                                           std::normal_distribution<double>()(random));
  return result;
}

}  // namespace

BinLikelihood BinOfData::likelihood(double model_error) const {
  if (left_out) return {};
  if (!saturated) return limited_simulation(*this, model_error);
  BinCounts known = *this;  // an empty simulation is known to be below about one count
  known.simulation = std::max(known.simulation, 1.0);
  return at_least(known, model_error);
}

std::vector<BinOfData> count_bins(const EventData& data, const LightSample& sample, double time) {
  std::vector<BinOfData> bins;
  bins.reserve(data.bins());
  for (const ModuleData& lit : data.lit()) {
    const float* from = sample.begin(lit.module);
    for (std::size_t b = 0; b < lit.counts.size(); ++b) {
      const float* to = sample.end(lit.module);
      if (b < lit.edges.size()) to = std::lower_bound(from, to, static_cast<float>(lit.edges[b] - time));
      const double simulated = double(to - from) + sample.repeats * lit.noise[b];
      bins.push_back(
          {{lit.counts[b], data.repeats(), simulated, sample.repeats}, lit.saturated, lit.left_out[b]});
      from = to;
    }
  }
  for (const std::uint32_t dark : data.dark())
    bins.push_back({{0, data.repeats(), double(sample.count(dark)) + sample.repeats * data.dark_noise(dark),
                     sample.repeats}});
  return bins;
}

double neg_llh(std::span<const BinOfData> bins, double model_error) {
  double sum = 0;
  for (const BinOfData& bin : bins) sum += bin.likelihood(model_error).value;
  return sum;
}

double jackknife_error(std::span<const double> values) {
  const double n = double(values.size()), mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  return std::sqrt(square * (n - 1) / n);
}

Evaluation evaluate_cascade(ExpectationModel& light, const EventData& data, const CascadeParameters& cascade,
                            double photons, double oversize, int repeats, std::uint64_t stream,
                            double model_error) {
  Evaluation result;
  for (int i = 0; i < repeats; ++i) {
    result.samples.push_back(
        light.sample({cascade, photons, oversize, stream + static_cast<std::uint64_t>(i)}));
    result.parts.push_back(count_bins(data, result.samples.back(), cascade.time));
  }
  result.bins = result.parts.front();
  for (std::size_t i = 1; i < result.parts.size(); ++i) add(result.bins, result.parts[i], 1);
  result.neg_llh = neg_llh(result.bins, model_error);
  for (const auto& part : result.parts) {
    std::vector<BinOfData> others = result.bins;
    add(others, part, -1);
    result.leave_one_out.push_back(neg_llh(others, model_error));
  }
  return result;
}

Difference difference(const Evaluation& a, const Evaluation& b) {
  std::vector<double> parts;
  for (std::size_t k = 0; k < a.leave_one_out.size(); ++k)
    parts.push_back(a.leave_one_out[k] - b.leave_one_out[k]);
  return {a.neg_llh - b.neg_llh, jackknife_error(parts)};
}

PseudoLikelihood draw_pseudo_data(std::span<const BinOfData> bins, double model_error,
                                  double charge_dispersion, std::uint64_t seed, int draws) {
  std::mt19937_64 random(seed);
  double sum = 0, square = 0;
  for (int k = 0; k < draws; ++k) {
    double value = 0;
    for (const BinOfData& bin : bins)
      value += redeal(bin, model_error, charge_dispersion, random).likelihood(model_error).value;
    sum += value;
    square += value * value;
  }
  const double mean = sum / draws;
  return {mean, std::sqrt(std::max(0.0, square / draws - mean * mean) * draws / (draws - 1.0))};
}

}  // namespace floe

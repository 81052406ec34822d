#include "reco/direct_fit/goodness_of_fit.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "reco/likelihood/bayesian_blocks.h"

namespace floe {
namespace {

// Inner edges of a module's bins become outer ones here: for noise, the first and last bin are finite.
double width(const EventData& data, const ModuleData& lit, std::size_t bin) {
  const double low = bin == 0 ? data.first_time() - EventData::margin : lit.edges[bin - 1];
  const double high = bin < lit.edges.size() ? lit.edges[bin] : data.last_time() + EventData::margin;
  return std::max(0.0, high - low);
}

// Adds the simulation of `part`, `sign` times.
void add(std::vector<BinCounts>& bins, std::span<const BinCounts> part, double sign) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].simulation = std::max(0.0, bins[i].simulation + sign * part[i].simulation);
    bins[i].simulation_events += sign * part[i].simulation_events;
  }
}

// The expected light of one module in cells of time, and draws of what a fit would find in it.
class PseudoModule {
 public:
  PseudoModule(const EventData& data, const ModuleData* lit, std::uint32_t index,
               const Evaluation& evaluation, double vertex_time)
      : events_(data.repeats()) {
    const double begin = data.first_time() - EventData::margin, end = data.last_time() + EventData::margin;
    const double first = std::floor(begin / cell);
    // A module that was dark is dim: all times are one cell.
    const std::size_t cells =
        lit ? static_cast<std::size_t>(std::max(1.0, std::ceil(end / cell) - first)) : 1;
    rates_.assign(cells, 0);
    double repeats = 0;
    for (const LightSample& sample : evaluation.samples) {
      repeats += sample.repeats;
      for (const float* time = sample.begin(index); time != sample.end(index); ++time) {
        const double place = std::floor((*time + vertex_time) / cell) - first;
        rates_[static_cast<std::size_t>(std::clamp(place, 0.0, double(cells - 1)))] += 1;
      }
    }
    simulation_events_ = repeats;
    smooth();
    const double noise = evaluation.noise_rate * 1e-9 * (end - begin) / double(cells);
    for (double& rate : rates_) rate = rate / repeats + noise;
    if (!lit) return;
    for (const double edge : lit->edges)
      error_cuts_.push_back(static_cast<std::size_t>(edge / cell - first + 0.5));
  }

  // -ln L of drawn data against a drawn simulation, in the drawn data's own bins.
  double draw(double model_error, std::mt19937_64& random) const {
    std::vector<double> data(rates_.size(), 0), simulation(rates_.size(), 0);
    std::normal_distribution<double> gauss(0, 1);
    double error = std::exp(model_error * gauss(random));
    std::size_t next_cut = 0;
    for (std::size_t i = 0; i < rates_.size(); ++i) {
      if (next_cut < error_cuts_.size() && i == error_cuts_[next_cut]) {
        error = std::exp(model_error * gauss(random));
        ++next_cut;
      }
      data[i] = poisson(rates_[i] * error * events_, random);
      simulation[i] = poisson(rates_[i] * simulation_events_, random);
    }
    std::vector<std::size_t> ends = bayesian_blocks(data);
    ends.push_back(rates_.size());
    double value = 0;
    for (std::size_t b = 0, i = 0; b < ends.size(); ++b) {
      BinCounts bin{0, events_, 0, simulation_events_};
      for (; i < ends[b]; ++i) bin.data += data[i], bin.simulation += simulation[i];
      value += limited_simulation(bin, model_error).value;
    }
    return value;
  }

 private:
  static constexpr double cell = block_cell;

  static double poisson(double mean, std::mt19937_64& random) {
    return mean > 0 ? double(std::poisson_distribution<long>(mean)(random)) : 0;
  }

  // The simulation's own blocks: counts spread evenly inside, or else its fluctuations would pass for light.
  void smooth() {
    std::vector<std::size_t> ends = bayesian_blocks(rates_);
    ends.push_back(rates_.size());
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      const auto from = rates_.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto to = rates_.begin() + static_cast<std::ptrdiff_t>(end);
      std::fill(from, to, std::accumulate(from, to, 0.0) / double(end - begin));
      begin = end;
    }
  }

  double events_, simulation_events_ = 1;
  std::vector<double> rates_;  // counts of one event in each cell
  std::vector<std::size_t>
      error_cuts_;  // cells at which another model error begins: the measured data's bins
};

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

double jackknife_error(std::span<const double> values) {
  const double n = double(values.size()), mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  return std::sqrt(square * (n - 1) / n);
}

Evaluation evaluate_cascade(ExpectationModel& light, const EventData& data, const CascadeParameters& cascade,
                            double photons, double oversize, int repeats, std::uint64_t stream,
                            double model_error, double noise_rate) {
  Evaluation result;
  result.noise_rate = noise_rate;
  std::vector<std::vector<BinCounts>> parts;
  for (int i = 0; i < repeats; ++i) {
    result.samples.push_back(
        light.sample({cascade, photons, oversize, stream + static_cast<std::uint64_t>(i)}));
    parts.push_back(count_bins(data, result.samples.back(), cascade.time, noise_rate));
  }
  std::vector<BinCounts> all = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) add(all, parts[i], 1);
  result.neg_llh = neg_llh(all, model_error);
  for (const auto& part : parts) {
    std::vector<BinCounts> others = all;
    add(others, part, -1);
    result.leave_one_out.push_back(neg_llh(others, model_error));
  }
  return result;
}

PseudoLikelihood draw_pseudo_data(const EventData& data, const Evaluation& evaluation, double vertex_time,
                                  double model_error, std::uint64_t seed, int threads, int draws) {
  const auto n = static_cast<std::size_t>(draws);
  const std::size_t modules = data.lit().size() + data.dark().size();
  std::vector<std::vector<double>> values(modules);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads > 0 ? threads : omp_get_max_threads())
  for (std::size_t i = 0; i < modules; ++i) {
    const ModuleData* lit = i < data.lit().size() ? &data.lit()[i] : nullptr;
    const std::uint32_t index = lit ? lit->module : data.dark()[i - data.lit().size()];
    std::seed_seq numbers{seed, std::uint64_t{index}};
    std::mt19937_64 random(numbers);
    const PseudoModule module(data, lit, index, evaluation, vertex_time);
    for (std::size_t k = 0; k < n; ++k) values[i].push_back(module.draw(model_error, random));
  }
  double sum = 0, square = 0;
  for (std::size_t k = 0; k < n; ++k) {
    double value = 0;
    for (const auto& module : values) value += module[k];
    sum += value;
    square += value * value;
  }
  const double mean = sum / draws;
  return {mean, std::sqrt(std::max(0.0, square / draws - mean * mean) * draws / (draws - 1.0))};
}

}  // namespace floe

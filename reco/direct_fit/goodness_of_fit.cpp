#include "reco/direct_fit/goodness_of_fit.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "reco/likelihood/bayesian_blocks.h"

namespace floe {
namespace {

// Adds the simulation of `part`, `sign` times.
void add(std::vector<BinOfData>& bins, std::span<const BinOfData> part, double sign) {
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
    const double begin = data.begin(), end = data.end();
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
    const double noise = data.dark_noise(index) / double(cells);
    for (double& rate : rates_) rate = rate / repeats + noise;
    if (!lit) return;
    saturated_at_ = lit->saturated ? lit->counts[0] : 0;
    for (std::size_t b = 0; b < lit->counts.size(); ++b) {
      if (!lit->left_out[b]) continue;
      const double low = b == 0 ? begin : lit->edges[b - 1],
                   high = b == lit->edges.size() ? end : lit->edges[b];
      for (std::size_t i = 0; i < cells; ++i) {
        const double centre = (first + double(i) + 0.5) * cell;
        if (centre >= low && centre < high) rates_[i] = 0;
      }
    }
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
    if (saturated_at_ > 0) {
      const double simulated = std::max(1.0, std::accumulate(simulation.begin(), simulation.end(), 0.0));
      return at_least({saturated_at_, events_, simulated, simulation_events_}, model_error).value;
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
  double saturated_at_ = 0;    // counts; 0: not saturated
  std::vector<double> rates_;  // counts of one event in each cell
  std::vector<std::size_t>
      error_cuts_;  // cells at which another model error begins: the measured data's bins
};

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
  std::vector<std::vector<BinOfData>> parts;
  for (int i = 0; i < repeats; ++i) {
    result.samples.push_back(
        light.sample({cascade, photons, oversize, stream + static_cast<std::uint64_t>(i)}));
    parts.push_back(count_bins(data, result.samples.back(), cascade.time));
  }
  std::vector<BinOfData> all = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) add(all, parts[i], 1);
  result.neg_llh = neg_llh(all, model_error);
  for (const auto& part : parts) {
    std::vector<BinOfData> others = all;
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

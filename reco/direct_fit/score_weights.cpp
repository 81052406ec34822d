#include "reco/direct_fit/score_weights.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "reco/direct_fit/goodness_of_fit.h"

namespace floe {
namespace {

constexpr double timing_share = 0.3;  // of an error in place that the geometry of times does not follow
constexpr double bright = 20;         // [photoelectrons] of a module that may lead the fit astray
constexpr double usual_scatter = 6;   // the largest of seven mean squares of a dozen simulations

}  // namespace

std::vector<double> simulation_gaps(const EventData& data, const Emulator& emulator,
                                    const LightSample& sample, Vector7 p, double time) {
  const auto counts = count_bins(data, sample, time);
  const double brighter = std::exp(p(6));
  p(6) = 0;
  std::vector<Emulator::Evaluation> values;
  emulator.evaluate(p, values);
  std::vector<double> gaps;
  gaps.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double noise = emulator.bins()[i].noise;
    const double simulated = (counts[i].simulation / counts[i].simulation_events - noise) / brighter;
    gaps.push_back(simulated - (std::exp(values[i].log_mean) - noise));
  }
  return gaps;
}

ScoreWeights::ScoreWeights(const EventData& data, const Emulator& emulator, double all_repeats,
                           std::span<const LightSample* const> judges, double position_error)
    : data_(data), emulator_(emulator), finite_(data.repeats() / all_repeats) {
  std::vector<Emulator::Evaluation> values;
  emulator_.evaluate(Vector7::Zero(), values);
  const double error = emulator_.settings().model_error;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Emulator::Bin& bin = emulator_.bins()[i];
    const double mean = data_.repeats() * std::exp(values[i].log_mean);
    means_.push_back(mean);
    // What the emulator cannot follow counts against a bin, as in the emulated likelihood.
    const double unknown = error * error + 1 / emulator_.bins()[i].effective_counts;
    const double variance = 1 + finite_ + unknown * mean;
    relative_variance_.push_back(variance);
    weights_.push_back(bin.left_out    ? Vector7::Zero()
                       : bin.saturated ? values[i].gradient
                                       : Vector7(values[i].gradient / variance));
    by_time_.push_back(values[i].gradient(5));
  }
  weaken_modules(judges);
  for_each_module([&](std::size_t begin, std::size_t end) { distrust_module(begin, end, position_error); });
}

Matrix7 ScoreWeights::poisson_variance() const {
  Matrix7 sum = Matrix7::Zero();
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (!emulator_.bins()[i].saturated)
      sum += means_[i] / data_.repeats() * weights_[i] * weights_[i].transpose();
  return sum;
}

template <class Do>
void ScoreWeights::for_each_module(Do what) const {
  const auto bins = emulator_.bins();
  for (std::size_t begin = 0, end = 0; begin < bins.size(); begin = end) {
    while (end < bins.size() && bins[end].module == bins[begin].module) ++end;
    what(begin, end);
  }
}

// Very near modules see light change in ways that the emulator cannot follow. Where simulations that no
// weight knows scatter in a module's sums by more than their counts explain, what finite simulation adds to
// the variance is that much larger for it: scatter that many photons average out does no harm.
void ScoreWeights::weaken_modules(std::span<const LightSample* const> judges) {
  std::vector<std::vector<double>> gaps;
  for (const LightSample* sample : judges) {
    const Vector7 place = emulator_.frame().of(light_centre(sample->cascade, emulator_.settings().kind));
    gaps.push_back(simulation_gaps(data_, emulator_, *sample, place, sample->cascade.time));
  }
  for_each_module([&](std::size_t begin, std::size_t end) { weaken_module(begin, end, judges, gaps); });
}

void ScoreWeights::weaken_module(std::size_t begin, std::size_t end,
                                 std::span<const LightSample* const> judges,
                                 std::span<const std::vector<double>> gaps) {
  const Emulator::Bin& first = emulator_.bins()[begin];
  if (first.saturated) return;
  Vector7 found = Vector7::Zero(), poisson = Vector7::Constant(1e-300);
  double light = 0;
  for (std::size_t i = begin; i < end; ++i) {
    light += means_[i];
    poisson += means_[i] / data_.repeats() * weights_[i].cwiseAbs2();
  }
  if (light < bright) return;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    Vector7 sum = Vector7::Zero();
    for (std::size_t i = begin; i < end; ++i) sum += gaps[k][i] * weights_[i];
    found += judges[k]->repeats * sum.cwiseAbs2() / double(gaps.size());
  }
  const double scatter = found.cwiseQuotient(poisson).maxCoeff();
  if (scatter <= usual_scatter) return;
  for (std::size_t i = begin; i < end; ++i) weights_[i] *= (1 + finite_) / (1 + finite_ * scatter);
}

// The emulator is not exact over the uncertainty of the place: one bright module may fix its time to 0.1
// ns, or its light to a per cent, better than anything moved by metres is known to be. Such sums would be
// far from linear over the region that matters. So each module's time and brightness are let float by what
// the uncertainty of the place leaves open, which takes that much out of the weights (Woodbury's formula).
void ScoreWeights::distrust_module(std::size_t begin, std::size_t end, double position_error) {
  const Emulator::Bin& first = emulator_.bins()[begin];
  if (first.saturated) return;
  const Vec3 way = data_.detector().modules()[first.module].position - emulator_.frame().origin().position;
  const double curved = position_error / soft_distance(way);
  const Eigen::Vector2d error(timing_share * light_slowness() * position_error * std::min(1.0, curved),
                              curved * curved);
  Eigen::Matrix2d known = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 7> sum = Eigen::Matrix<double, 2, 7>::Zero(), left = sum;
  const auto nuisance = [&](std::size_t i) -> Eigen::Vector2d {
    return error.cwiseProduct(Eigen::Vector2d(by_time_[i], 1));
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (emulator_.bins()[i].left_out) continue;
    known += means_[i] / relative_variance_[i] * nuisance(i) * nuisance(i).transpose();
    sum += means_[i] * nuisance(i) * weights_[i].transpose();
  }
  const Eigen::Matrix<double, 2, 7> part = (Eigen::Matrix2d::Identity() + known).llt().solve(sum);
  for (std::size_t i = begin; i < end; ++i) {
    if (emulator_.bins()[i].left_out) continue;
    weights_[i] -= part.transpose() * nuisance(i) / relative_variance_[i];
    left += means_[i] * nuisance(i) * weights_[i].transpose();
  }
  distrust_ += left.transpose() * left;
}

}  // namespace floe

#include "reco/direct_fit/emulator.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "reco/likelihood/limited_simulation.h"

namespace floe {
namespace {

constexpr double most_variance = 1e6;  // relative, of a bin that nothing is known of
constexpr double profile_floor = 1;    // counts added to every bin of a profile when it is shifted

}  // namespace

Emulator::Emulator(const EventData& data, const MeanIce& ice, const LightCentre& origin,
                   std::span<const LightSample* const> samples, const EmulatorSettings& settings)
    : data_(&data), frame_(origin), settings_(settings) {
  assert(!samples.empty());
  modules_ = train(data, ice, frame_, samples, settings.kind, settings.threads);
  for (const ModuleLight& module : modules_)
    for (std::size_t b = 0; b < module.bin_count(); ++b) {
      const Regression& fit = module.bins[b];
      Bin bin;
      bin.module = module.index;
      bin.effective_counts = 1 / (fit.covariance(0, 0) + std::min(fit.excess_variance, most_variance));
      bin.noise = module.data ? module.data->noise[b] : data.dark_noise(module.index);
      if (module.data) {
        bin.data = module.data->counts[b];
        bin.saturated = module.data->saturated;
        bin.left_out = module.data->left_out[b];
      }
      bins_.push_back(bin);
    }
}

void Emulator::evaluate_module(const ModuleLight& module, std::size_t first_bin, const Vector7& p,
                               const LightCentre& at, const LocalFrame::DirectionChange& turn,
                               std::vector<Evaluation>& result) const {
  const Sight seen = sight(at.position, at.direction, module.position);
  const PointLight light = point_light(seen.distance, module.ice);
  const ShapeTerms terms = terms_of(seen) - module.origin_terms, by_cosine = terms_by_cosine(seen);
  const double later = p(5) + light_slowness() * (seen.distance - module.distance);

  double low = 0, low_shifted = 0, low_density = 0;  // of the profile, at the bin's lower edge
  for (std::size_t b = 0; b < module.bin_count(); ++b) {
    const Coefficients& c = module.bins[b].coefficients;
    Evaluation& e = result[first_bin + b];
    const ShapeTerms& shape = module.shapes[b];
    e.log_mean = light.log_light + shape.dot(terms) + p(6) + c(0) + c.tail<5>().dot(p.head<5>());
    const double by_distance = light.slope + shape(shape_terms - 1) / shape_length;
    const double shape_by_cosine = shape.dot(by_cosine);
    e.gradient << by_distance * seen.distance_by_place + shape_by_cosine * seen.cosine_by_place +
                      c.segment<3>(1),
        c.tail<2>() + shape_by_cosine * turn * seen.cosine_by_direction, 0, 1;
    if (module.bin_count() > 1) {
      double high = module.profile.total(), high_shifted = high, high_density = 0;
      if (b < module.edges.size()) {
        high = module.profile.cumulative(module.edges[b]);
        high_shifted = module.profile.cumulative(module.edges[b] - later);
        high_density = module.profile.density(module.edges[b] - later);
      }
      const double shifted = high_shifted - low_shifted + profile_floor;
      const double slope = -(high_density - low_density) / shifted;  // d ln(share) / d later
      e.log_mean += std::log(shifted / (high - low + profile_floor));
      e.gradient.head<3>() += slope * light_slowness() * seen.distance_by_place;
      e.gradient(5) = slope;
      low = high, low_shifted = high_shifted, low_density = high_density;
    }
    const double noise = bins_[first_bin + b].noise;
    if (noise > 0) {
      const double mean = std::exp(e.log_mean);
      e.log_mean = std::log(mean + noise);
      e.gradient *= mean / (mean + noise);
    }
  }
}

void Emulator::evaluate(const Vector7& p, std::vector<Evaluation>& result) const {
  result.resize(bins_.size());
  const LightCentre at = frame_.at(p);
  const LocalFrame::DirectionChange turn = frame_.direction_change(p);
  std::size_t first_bin = 0;
  for (const ModuleLight& module : modules_) {
    evaluate_module(module, first_bin, p, at, turn, result);
    first_bin += module.bin_count();
  }
}

BinLikelihood Emulator::likelihood(const Bin& bin, double log_mean) const {
  if (bin.left_out) return {};
  const BinCounts counts{bin.data, repeats(), bin.effective_counts,
                         bin.effective_counts / std::exp(log_mean)};
  return bin.saturated ? at_least(counts, settings_.model_error)
                       : limited_simulation(counts, settings_.model_error);
}

double Emulator::neg_llh(const Vector7& p) const {
  std::vector<Evaluation> values;
  evaluate(p, values);
  double sum = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) sum += likelihood(bins_[i], values[i].log_mean).value;
  return sum;
}

Matrix7 Emulator::information(const Vector7& p) const {
  std::vector<Evaluation> values;
  evaluate(p, values);
  Matrix7 sum = Matrix7::Zero();
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (bins_[i].left_out) continue;
    const double weight = bins_[i].saturated
                              ? likelihood(bins_[i], values[i].log_mean).curvature
                              : expected_curvature(repeats() * std::exp(values[i].log_mean),
                                                   bins_[i].effective_counts, settings_.model_error);
    sum += weight * values[i].gradient * values[i].gradient.transpose();
  }
  return sum;
}

}  // namespace floe

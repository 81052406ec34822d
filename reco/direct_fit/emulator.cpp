#include "reco/direct_fit/emulator.h"

#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "data/base/constants.h"
#include "reco/likelihood/limited_simulation.h"

namespace floe {

// One simulation as the regressions see it.
struct Emulator::SampleView {
  const LightSample* sample;
  Coordinates place;
  Vec3 centre;
  double delay;   // from the vertex time to the light centre's [ns]
  double offset;  // ln(light of all repeats, relative to the origin's cascade)
};

namespace {

constexpr double profile_step = 5;      // of arrival profiles [ns]
constexpr double profile_margin = 150;  // beyond the outermost inner edges [ns]
constexpr double profile_floor = 1;     // counts added to every bin of a profile when it is shifted
constexpr double shell = 25;            // width of the radial bins of the global brightness [m]
constexpr std::size_t shells = 40;

// How far simulations may pull a dependence from its prior: a module's from the point light, a bin's from
// its module. [1], [1/m], [1/rad].
const Coefficients module_sigma = (Coefficients() << 1, 0.03, 0.03, 0.03, 1, 1).finished();
const Coefficients bin_sigma = (Coefficients() << 3, 0.03, 0.03, 0.03, 1, 1).finished();

std::size_t shell_of(double distance) {
  return std::min(shells - 1, static_cast<std::size_t>(distance / shell));
}

int thread_count(int threads) {
  return threads > 0 ? threads : omp_get_max_threads();
}

// 1 / variance of the logarithm of a bin's expectation at the origin.
double effective_counts(const Regression& fit) {
  return 1 / (fit.covariance(0, 0) + fit.excess_variance);
}

}  // namespace

Emulator::Emulator(const EventData& data, const MeanIce& ice, const LightCentre& origin,
                   std::span<const LightSample* const> samples, const EmulatorSettings& settings)
    : data_(&data), frame_(origin), settings_(settings) {
  assert(!samples.empty());
  std::vector<SampleView> views;
  for (const LightSample* sample : samples) {
    const LightCentre light = light_centre(sample->cascade, settings.kind);
    const Vector7 local = frame_.of(light);
    views.push_back({sample, local.head<5>(), light.position, light.time - sample->cascade.time,
                     std::log(sample->repeats) + local(6)});
  }

  // Modules in a fixed order: lit ones first.
  const auto& detector = data.detector().modules();
  std::vector<std::uint32_t> indices;
  for (const ModuleData& lit : data.lit()) indices.push_back(lit.module);
  indices.insert(indices.end(), data.dark().begin(), data.dark().end());
  modules_.resize(indices.size());
  std::size_t bins = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    ModuleModel& module = modules_[i];
    module.position = detector[indices[i]].position;
    module.ice = ice.between(origin.position.z(), module.position.z());
    module.distance = soft_distance(origin.position - module.position);
    module.first_bin = bins;
    module.bin_count = i < data.lit().size() ? data.lit()[i].counts.size() : 1;
    bins += module.bin_count;
  }
  bins_.resize(bins);
  coefficients_.resize(bins);

  // How bright the point light has to be in shells of distance; each shell leans on the one before it.
  std::vector<double> simulated(shells, 0), expected(shells, 0);
  for (std::size_t i = 0; i < indices.size(); ++i)
    for (const SampleView& view : views) {
      const double distance = soft_distance(view.centre - modules_[i].position);
      simulated[shell_of(modules_[i].distance)] += double(view.sample->count(indices[i]));
      expected[shell_of(modules_[i].distance)] +=
          std::exp(view.offset + point_light(distance, modules_[i].ice).log_light);
    }
  std::vector<double> log_ratio(shells, 0);
  double all_simulated = 1, all_expected = 1e-30;
  for (std::size_t k = 0; k < shells; ++k) all_simulated += simulated[k], all_expected += expected[k];
  double ratio = all_simulated / all_expected;
  for (std::size_t k = 0; k < shells; ++k) {
    ratio = (simulated[k] + 1) / (expected[k] + 1 / ratio);
    log_ratio[k] = std::log(ratio);
  }

#pragma omp parallel for schedule(dynamic, 16) num_threads(thread_count(settings.threads))
  for (std::size_t i = 0; i < indices.size(); ++i)
    build_module(modules_[i], indices[i], i < data.lit().size() ? &data.lit()[i] : nullptr, views, log_ratio);
}

void Emulator::build_module(ModuleModel& module, std::uint32_t index, const ModuleData* data,
                            std::span<const SampleView> samples, std::span<const double> log_ratio) {
  const std::size_t n = samples.size();
  std::vector<RegressionPoint> points(n);
  std::vector<double> delays(n), counts(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double distance = soft_distance(samples[k].centre - module.position);
    points[k] = {samples[k].place, samples[k].offset + point_light(distance, module.ice).log_light};
    delays[k] = samples[k].delay + light_slowness() * distance;
    counts[k] = double(samples[k].sample->count(index));
  }
  RegressionPrior prior{Coefficients::Zero(), module_sigma};
  prior.mean(0) = log_ratio[shell_of(module.distance)];
  const Regression whole = fit_poisson(points, counts, prior);
  if (module.bin_count == 1) {
    coefficients_[module.first_bin] = whole.coefficients;
    bins_[module.first_bin] = {data ? data->charge : 0, effective_counts(whole)};
    return;
  }

  module.edges = data->edges;
  for (double& edge : module.edges) edge -= frame_.origin().time + light_slowness() * module.distance;
  module.profile = ArrivalProfile(module.edges.front() - profile_margin, module.edges.back() + profile_margin,
                                  profile_step);
  for (std::size_t k = 0; k < n; ++k) {
    const LightSample& sample = *samples[k].sample;
    for (const float* time = sample.begin(index); time != sample.end(index); ++time)
      module.profile.add(*time - delays[k], 1);
  }
  module.profile.close();

  prior.mean = whole.coefficients;
  prior.mean(0) -= std::log(double(module.bin_count));
  prior.sigma = bin_sigma;
  std::vector<std::size_t> before(n, 0);  // hits before the bin
  for (std::size_t b = 0; b < module.bin_count; ++b) {
    for (std::size_t k = 0; k < n; ++k) {
      const LightSample& sample = *samples[k].sample;
      std::size_t after = sample.count(index);
      if (b < module.edges.size()) {
        const float edge = static_cast<float>(module.edges[b] + delays[k]);
        after = static_cast<std::size_t>(std::lower_bound(sample.begin(index), sample.end(index), edge) -
                                         sample.begin(index));
      }
      counts[k] = double(after - before[k]);
      before[k] = after;
    }
    const Regression fit = fit_poisson(points, counts, prior);
    coefficients_[module.first_bin + b] = fit.coefficients;
    bins_[module.first_bin + b] = {data->counts[b], effective_counts(fit)};
  }
}

double Emulator::noise_counts(const ModuleModel& module, std::size_t bin) const {
  if (settings_.noise_rate == 0) return 0;
  const double begin = data_->first_time() - EventData::margin, end = data_->last_time() + EventData::margin;
  const double shift = frame_.origin().time + light_slowness() * module.distance;
  const double low = bin == 0 ? begin : module.edges[bin - 1] + shift;
  const double high = bin + 1 == module.bin_count ? end : module.edges[bin] + shift;
  return settings_.noise_rate * 1e-9 * std::max(0.0, high - low);
}

void Emulator::evaluate_module(const ModuleModel& module, const Vector7& p, const Vec3& centre,
                               std::vector<Evaluation>& result) const {
  const Vec3 offset = centre - module.position;
  const double distance = soft_distance(offset);
  const Vec3 outward = offset / distance;  // gradient of the distance
  const PointLight light = point_light(distance, module.ice);
  const double later = p(5) + light_slowness() * (distance - module.distance);

  double low = 0, low_shifted = 0, low_density = 0;  // of the profile, at the bin's lower edge
  for (std::size_t b = 0; b < module.bin_count; ++b) {
    const Coefficients& c = coefficients_[module.first_bin + b];
    Evaluation& e = result[module.first_bin + b];
    e.log_mean = light.log_light + p(6) + c(0) + c.tail<5>().dot(p.head<5>());
    e.gradient << light.slope * outward + c.segment<3>(1), c(4), c(5), 0, 1;
    if (module.bin_count > 1) {
      double high = module.profile.total(), high_shifted = high, high_density = 0;
      if (b < module.edges.size()) {
        high = module.profile.cumulative(module.edges[b]);
        high_shifted = module.profile.cumulative(module.edges[b] - later);
        high_density = module.profile.density(module.edges[b] - later);
      }
      const double shifted = high_shifted - low_shifted + profile_floor;
      const double slope = -(high_density - low_density) / shifted;  // d ln(share) / d later
      e.log_mean += std::log(shifted / (high - low + profile_floor));
      e.gradient.head<3>() += slope * light_slowness() * outward;
      e.gradient(5) = slope;
      low = high, low_shifted = high_shifted, low_density = high_density;
    }
    const double noise = noise_counts(module, b);
    if (noise > 0) {
      const double mean = std::exp(e.log_mean);
      e.log_mean = std::log(mean + noise);
      e.gradient *= mean / (mean + noise);
    }
  }
}

void Emulator::evaluate(const Vector7& p, std::vector<Evaluation>& result) const {
  result.resize(bins_.size());
  const Vec3 centre = frame_.at(p).position;
  for (const ModuleModel& module : modules_) evaluate_module(module, p, centre, result);
}

double Emulator::neg_llh(const Vector7& p) const {
  std::vector<Evaluation> values;
  evaluate(p, values);
  double sum = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const BinCounts counts{bins_[i].data, repeats(), bins_[i].effective_counts,
                           bins_[i].effective_counts / std::exp(values[i].log_mean)};
    sum += limited_simulation(counts, settings_.model_error).value;
  }
  return sum;
}

Matrix7 Emulator::information(const Vector7& p) const {
  std::vector<Evaluation> values;
  evaluate(p, values);
  Matrix7 sum = Matrix7::Zero();
  for (std::size_t i = 0; i < bins_.size(); ++i)
    sum += expected_curvature(repeats() * std::exp(values[i].log_mean), bins_[i].effective_counts,
                              settings_.model_error) *
           values[i].gradient * values[i].gradient.transpose();
  return sum;
}

}  // namespace floe

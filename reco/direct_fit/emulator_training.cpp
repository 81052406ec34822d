#include "reco/direct_fit/emulator_training.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace floe {
namespace {

constexpr double profile_step = 5;      // of arrival profiles [ns]
constexpr double profile_margin = 150;  // beyond the outermost inner edges [ns]
constexpr double shell_width = 25;      // of the shells in which the point light's brightness is learnt [m]
constexpr std::size_t shells = 40;
constexpr int evidence_rounds = 4;

std::size_t shell_of(double distance) {
  return std::min(shells - 1, static_cast<std::size_t>(distance / shell_width));
}

// One simulation as the regressions see it.
struct SampleView {
  const LightSample* sample;
  Coordinates place;
  Vec3 centre;
  double delay;   // from the vertex time to the light centre's [ns]
  double offset;  // ln(light of all repeats, relative to the origin's cascade)
};

std::vector<SampleView> view(std::span<const LightSample* const> samples, const LocalFrame& frame,
                             CascadeKind kind) {
  std::vector<SampleView> views;
  for (const LightSample* sample : samples) {
    const LightCentre light = light_centre(sample->cascade, kind);
    const Vector7 local = frame.of(light);
    views.push_back({sample, local.head<5>(), light.position, light.time - sample->cascade.time,
                     std::log(sample->repeats) + local(6)});
  }
  return views;
}

// How widely slopes spread about what they are drawn to, for modules at similar distances.
struct SlopeSpread {
  double position = 0.02;  // [1/m]
  double direction = 0.7;  // [1/rad]

  Coefficients sigma(double constant) const {
    return (Coefficients() << constant, position, position, position, direction, direction).finished();
  }
};
constexpr std::array<double, 4> distance_classes{40, 80, 150, 1e9};  // upper ends [m]
using SlopeSpreads = std::array<SlopeSpread, distance_classes.size()>;

std::size_t class_of(double distance) {
  std::size_t k = 0;
  while (distance > distance_classes[k]) ++k;
  return k;
}

// The evidence approximation's fixed point: spread^2 = (sum of squared deviations) / (number of slopes that
// the counts, rather than the prior, determine).
class EvidenceSum {
 public:
  void add(const Regression& fit, const Coefficients& prior_mean, const SlopeSpread& spread) {
    for (int i = 1; i < regression_terms; ++i) {
      const bool direction = i > 3;
      const double width = direction ? spread.direction : spread.position;
      const double gap = fit.coefficients(i) - prior_mean(i);
      square_[direction] += gap * gap;
      determined_[direction] += std::max(0.0, 1 - fit.covariance(i, i) / (width * width));
    }
  }
  SlopeSpread update(const SlopeSpread& old) const {
    return {updated(0, old.position, 0.002, 0.1), updated(1, old.direction, 0.03, 5)};
  }

 private:
  double updated(int i, double old, double least, double most) const {
    if (determined_[i] < 1) return old;  // nothing learnt
    return std::clamp(std::sqrt(square_[i] / determined_[i]), least, most);
  }
  double square_[2] = {0, 0}, determined_[2] = {0, 0};
};

// The counts of one module in all simulations.
struct ModuleCounts {
  std::vector<RegressionPoint> points;    // one a simulation
  std::vector<double> whole;              // counts of all times
  std::vector<std::vector<double>> bins;  // [bin][simulation]; empty with one bin
  Regression whole_fit;
};

ModuleCounts count(ModuleLight& module, std::span<const SampleView> samples) {
  ModuleCounts counts;
  if (module.bin_count() > 1) {
    module.profile = ArrivalProfile(module.edges.front() - profile_margin,
                                    module.edges.back() + profile_margin, profile_step);
    counts.bins.assign(module.bin_count(), {});
  }
  for (const SampleView& view : samples) {
    const double distance = soft_distance(view.centre - module.position);
    const double delay = view.delay + light_slowness() * distance;
    counts.points.push_back({view.place, view.offset + point_light(distance, module.ice).log_light});
    counts.whole.push_back(double(view.sample->count(module.index)));
    if (module.bin_count() == 1) continue;

    const float *from = view.sample->begin(module.index), *end = view.sample->end(module.index);
    for (const float* time = from; time != end; ++time) module.profile.add(*time - delay, 1);
    for (std::size_t b = 0; b < module.bin_count(); ++b) {
      const float* to = end;
      if (b < module.edges.size())
        to = std::lower_bound(from, end, static_cast<float>(module.edges[b] + delay));
      counts.bins[b].push_back(double(to - from));
      from = to;
    }
  }
  module.profile.close();
  return counts;
}

// ln(brightness of the point light) in shells of distance; each shell leans on the one before it.
std::vector<double> brightness(std::span<const ModuleLight> modules, std::span<const ModuleCounts> counts) {
  std::vector<double> simulated(shells, 0), expected(shells, 0);
  double all_simulated = 1, all_expected = 1e-30;
  for (std::size_t i = 0; i < modules.size(); ++i)
    for (std::size_t k = 0; k < counts[i].points.size(); ++k) {
      const double mean = std::exp(counts[i].points[k].offset);
      simulated[shell_of(modules[i].distance)] += counts[i].whole[k];
      expected[shell_of(modules[i].distance)] += mean;
      all_simulated += counts[i].whole[k];
      all_expected += mean;
    }
  std::vector<double> result;
  double ratio = all_simulated / all_expected;
  for (std::size_t k = 0; k < shells; ++k) {
    ratio = (simulated[k] + 1) / (expected[k] + 1 / ratio);
    result.push_back(std::log(ratio));
  }
  return result;
}

RegressionPrior module_prior(const ModuleLight& module, std::span<const double> log_brightness,
                             const SlopeSpread& spread) {
  RegressionPrior prior{Coefficients::Zero(), spread.sigma(1)};
  prior.mean(0) = log_brightness[shell_of(module.distance)];
  return prior;
}

// A bin holds an even share of its module's light, give or take a factor of 20.
RegressionPrior bin_prior(const ModuleLight& module, const Regression& whole, const SlopeSpread& spread) {
  RegressionPrior prior{whole.coefficients, spread.sigma(3)};
  prior.mean(0) -= std::log(double(module.bin_count()));
  return prior;
}

// Fits every unit, learns how widely slopes spread, and again. `fit(i, spread)` fits module i, possibly in
// parallel; `learn(i, spread, sum)` adds what it found.
template <class Fit, class Learn>
void fit_with_evidence(std::span<const ModuleLight> modules, int threads, Fit fit, Learn learn) {
  SlopeSpreads spreads;
  for (int round = 0; round < evidence_rounds; ++round) {
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
    for (std::size_t i = 0; i < modules.size(); ++i) fit(i, spreads[class_of(modules[i].distance)]);
    std::array<EvidenceSum, distance_classes.size()> sums;
    for (std::size_t i = 0; i < modules.size(); ++i) {
      const std::size_t k = class_of(modules[i].distance);
      learn(i, spreads[k], sums[k]);
    }
    for (std::size_t k = 0; k < spreads.size(); ++k) spreads[k] = sums[k].update(spreads[k]);
  }
}

std::vector<ModuleLight> list_modules(const EventData& data, const MeanIce& ice, const LightCentre& origin) {
  std::vector<ModuleLight> modules;
  const auto add = [&](std::uint32_t index, const ModuleData* lit) {
    ModuleLight module;
    module.index = index;
    module.data = lit;
    module.position = data.detector().modules()[index].position;
    module.ice = ice.between(origin.position.z(), module.position.z());
    module.distance = soft_distance(origin.position - module.position);
    module.bins.resize(module.bin_count());
    if (lit) module.edges = lit->edges;
    for (double& edge : module.edges) edge -= origin.time + light_slowness() * module.distance;
    modules.push_back(std::move(module));
  };
  for (const ModuleData& lit : data.lit()) add(lit.module, &lit);
  for (const std::uint32_t dark : data.dark()) add(dark, nullptr);
  return modules;
}

}  // namespace

std::vector<ModuleLight> train(const EventData& data, const MeanIce& ice, const LocalFrame& frame,
                               std::span<const LightSample* const> samples, CascadeKind kind, int threads) {
  threads = threads > 0 ? threads : omp_get_max_threads();
  std::vector<ModuleLight> modules = list_modules(data, ice, frame.origin());
  std::vector<ModuleCounts> counts(modules.size());
  const std::vector<SampleView> views = view(samples, frame, kind);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < modules.size(); ++i) counts[i] = count(modules[i], views);

  const std::vector<double> log_brightness = brightness(modules, counts);
  fit_with_evidence(
      modules, threads,
      [&](std::size_t i, const SlopeSpread& spread) {
        counts[i].whole_fit =
            fit_poisson(counts[i].points, counts[i].whole, module_prior(modules[i], log_brightness, spread));
      },
      [&](std::size_t i, const SlopeSpread& spread, EvidenceSum& sum) {
        sum.add(counts[i].whole_fit, module_prior(modules[i], log_brightness, spread).mean, spread);
      });
  fit_with_evidence(
      modules, threads,
      [&](std::size_t i, const SlopeSpread& spread) {
        if (modules[i].bin_count() == 1) {
          modules[i].bins[0] = counts[i].whole_fit;
          return;
        }
        const RegressionPrior prior = bin_prior(modules[i], counts[i].whole_fit, spread);
        for (std::size_t b = 0; b < modules[i].bin_count(); ++b)
          modules[i].bins[b] = fit_poisson(counts[i].points, counts[i].bins[b], prior);
      },
      [&](std::size_t i, const SlopeSpread& spread, EvidenceSum& sum) {
        if (modules[i].bin_count() == 1) return;
        const Coefficients mean = bin_prior(modules[i], counts[i].whole_fit, spread).mean;
        for (const Regression& fit : modules[i].bins) sum.add(fit, mean, spread);
      });
  return modules;
}

}  // namespace floe

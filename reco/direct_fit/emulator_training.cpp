#include "reco/direct_fit/emulator_training.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "propagation/engine/threads.h"

namespace floe {
namespace {

constexpr double profile_step = 5;      // of arrival profiles [ns]
constexpr double profile_margin = 150;  // beyond the outermost inner edges [ns]
constexpr double lent_counts = 300;     // of the profile that similar modules have in common
constexpr double shell_width = 25;      // of the shells in which the point light's brightness is learnt [m]
constexpr std::size_t shells = 40;
constexpr int evidence_rounds = 5;

std::size_t shell_of(double distance) {
  return std::min(shells - 1, static_cast<std::size_t>(distance / shell_width));
}

// One simulation as the regressions see it.
struct SampleView {
  const LightSample* sample;
  Coordinates place;
  LightCentre light;
  double delay;   // from the vertex time to the light centre's [ns]
  double offset;  // ln(light of all repeats, relative to the origin's cascade)
};

std::vector<SampleView> view(std::span<const LightSample* const> samples, const LocalFrame& frame,
                             CascadeKind kind) {
  std::vector<SampleView> views;
  for (const LightSample* sample : samples) {
    const LightCentre light = light_centre(sample->cascade, kind);
    const Vector7 local = frame.of(light);
    views.push_back({sample, local.head<5>(), light, light.time - sample->cascade.time,
                     std::log(sample->repeats) + local(6)});
  }
  return views;
}

// How widely slopes spread about what they are drawn to, for modules at similar distances.
struct SlopeSpread {
  double position = 0.01;   // [1/m]
  double direction = 0.25;  // [1/rad]

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
  std::vector<RegressionPoint> points;    // one a simulation; offsets of the point light
  std::vector<double> offsets;            // the same offsets
  std::vector<ShapeTerms> terms;          // one a simulation, less those of the origin
  std::vector<double> whole;              // counts of all times
  std::vector<std::vector<double>> bins;  // [bin][simulation]; empty with one bin
  std::vector<double> mean_times;         // of each bin's light, after the direct light [ns]
  Regression whole_fit;
};

ModuleCounts count(ModuleLight& module, std::span<const SampleView> samples, const ArrivalProfile& empty) {
  ModuleCounts counts;
  if (module.bin_count() > 1) {
    module.profile = empty;
    counts.bins.assign(module.bin_count(), {});
    counts.mean_times.assign(module.bin_count(), 0);
  }
  for (const SampleView& view : samples) {
    const Sight seen = sight(view.light.position, view.light.direction, module.position);
    const double delay = view.delay + light_slowness() * seen.distance;
    counts.terms.push_back(terms_of(seen) - module.origin_terms);
    counts.offsets.push_back(view.offset + point_light(seen.distance, module.ice).log_light);
    counts.points.push_back({view.place, counts.offsets.back()});
    counts.whole.push_back(double(view.sample->count(module.index)));
    if (module.bin_count() == 1) continue;

    const float *from = view.sample->begin(module.index), *end = view.sample->end(module.index);
    for (const float* time = from; time != end; ++time) module.profile.add(*time - delay, 1);
    for (std::size_t b = 0; b < module.bin_count(); ++b) {
      const float* to = end;
      if (b < module.edges.size())
        to = std::lower_bound(from, end, static_cast<float>(module.edges[b] + delay));
      counts.bins[b].push_back(double(to - from));
      for (; from != to; ++from) counts.mean_times[b] += *from - delay;
    }
  }
  for (std::size_t b = 0; b < counts.bins.size(); ++b)
    counts.mean_times[b] /= std::max(1.0, std::accumulate(counts.bins[b].begin(), counts.bins[b].end(), 0.0));
  return counts;
}

// Bins that share a shape: of modules at similar distances, of all times (0) or of light that came at similar
// times after the direct light.
constexpr std::array<double, 6> shape_distances{30, 60, 100, 160, 250, 1e9};  // upper ends [m]
constexpr std::array<double, 4> shape_times{30, 100, 250, 1e9};               // upper ends [ns]
constexpr std::size_t shape_classes = shape_distances.size() * (1 + shape_times.size());

std::size_t shape_class(double distance, std::size_t time_class) {
  std::size_t k = 0;
  while (k + 1 < shape_distances.size() && distance > shape_distances[k]) ++k;
  return k * (1 + shape_times.size()) + time_class;
}
std::size_t time_class(double time) {
  std::size_t k = 0;
  while (k + 1 < shape_times.size() && time > shape_times[k]) ++k;
  return 1 + k;
}

// The shapes of all classes; those of all times in class 0 of a distance.
std::vector<ShapeTerms> fit_shapes(std::span<const ModuleLight> modules, std::span<const ModuleCounts> counts,
                                   int threads) {
  std::vector<std::vector<ShapeUnit>> units(shape_classes);
  for (std::size_t i = 0; i < modules.size(); ++i) {
    units[shape_class(modules[i].distance, 0)].push_back(
        {counts[i].terms, counts[i].offsets, counts[i].whole});
    for (std::size_t b = 0; b < counts[i].bins.size(); ++b)
      units[shape_class(modules[i].distance, time_class(counts[i].mean_times[b]))].push_back(
          {counts[i].terms, counts[i].offsets, counts[i].bins[b]});
  }
  std::vector<ShapeTerms> shapes(shape_classes);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t distance = 0; distance < shape_classes; distance += 1 + shape_times.size()) {
    shapes[distance] = fit_shape(units[distance], ShapeTerms::Zero());
    for (std::size_t k = distance + 1; k <= distance + shape_times.size(); ++k)
      shapes[k] = fit_shape(units[k], shapes[distance]);
  }
  return shapes;
}

// The regression's points with a shape in their offsets.
std::vector<RegressionPoint> with_shape(const ModuleCounts& counts, const ShapeTerms& shape) {
  std::vector<RegressionPoint> points = counts.points;
  for (std::size_t k = 0; k < points.size(); ++k) points[k].offset += shape.dot(counts.terms[k]);
  return points;
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

// A profile for the times of all modules' edges.
ArrivalProfile empty_profile(std::span<const ModuleLight> modules) {
  double low = 0, high = 500;
  for (const ModuleLight& module : modules)
    for (const double edge : module.edges) low = std::min(low, edge), high = std::max(high, edge);
  return {std::max(low, -500.0) - profile_margin, std::min(high, 3000.0) + profile_margin, profile_step};
}

// A profile of few counts is all noise in its density, and noise in a dependence passes for information:
// every profile is blended with that of all modules at similar distances and angles to the cascade.
void blend_profiles(std::vector<ModuleLight>& modules, std::span<const ModuleCounts> counts,
                    const ArrivalProfile& empty) {
  constexpr std::size_t angles = 3;
  std::vector<ArrivalProfile> common(shells * angles, empty);
  std::vector<double> total(common.size(), 0);
  const auto group = [](const ModuleLight& module) {
    const double cosine = module.origin_terms(0);  // P1
    return shell_of(module.distance) * angles + (cosine < -0.3 ? 0 : cosine < 0.3 ? 1 : 2);
  };
  for (std::size_t i = 0; i < modules.size(); ++i) {
    if (modules[i].bin_count() == 1) continue;
    common[group(modules[i])].add(modules[i].profile, 1);
    total[group(modules[i])] += std::accumulate(counts[i].whole.begin(), counts[i].whole.end(), 0.0);
  }
  for (ModuleLight& module : modules) {
    if (module.bin_count() == 1) continue;
    const std::size_t k = group(module);
    module.profile.add(common[k], lent_counts / std::max(total[k], 1.0));
    module.profile.close();
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
    module.origin_terms = terms_of(sight(origin.position, origin.direction, module.position));
    module.bins.resize(module.bin_count());
    module.shapes.resize(module.bin_count());
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
  threads = thread_count(threads);
  std::vector<ModuleLight> modules = list_modules(data, ice, frame.origin());
  std::vector<ModuleCounts> counts(modules.size());
  const std::vector<SampleView> views = view(samples, frame, kind);
  const ArrivalProfile empty = empty_profile(modules);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < modules.size(); ++i) counts[i] = count(modules[i], views, empty);
  blend_profiles(modules, counts, empty);

  const std::vector<ShapeTerms> shapes = fit_shapes(modules, counts, threads);
  const auto whole_shape = [&](std::size_t i) { return shapes[shape_class(modules[i].distance, 0)]; };
  for (std::size_t i = 0; i < modules.size(); ++i) {
    modules[i].shapes[0] = whole_shape(i);
    for (std::size_t b = 0; b < counts[i].bins.size(); ++b)
      modules[i].shapes[b] = shapes[shape_class(modules[i].distance, time_class(counts[i].mean_times[b]))];
  }

  const std::vector<double> log_brightness = brightness(modules, counts);
  fit_with_evidence(
      modules, threads,
      [&](std::size_t i, const SlopeSpread& spread) {
        counts[i].whole_fit = fit_poisson(with_shape(counts[i], whole_shape(i)), counts[i].whole,
                                          module_prior(modules[i], log_brightness, spread));
      },
      [&](std::size_t i, const SlopeSpread& spread, EvidenceSum& sum) {
        sum.add(counts[i].whole_fit, module_prior(modules[i], log_brightness, spread).mean, spread);
      });
  fit_with_evidence(
      modules, threads,
      [&](std::size_t i, const SlopeSpread& spread) {
        ModuleLight& module = modules[i];
        if (module.bin_count() == 1) {
          module.bins[0] = counts[i].whole_fit;
          return;
        }
        const RegressionPrior prior = bin_prior(module, counts[i].whole_fit, spread);
        for (std::size_t b = 0; b < module.bin_count(); ++b)
          module.bins[b] = fit_poisson(with_shape(counts[i], module.shapes[b]), counts[i].bins[b], prior);
      },
      [&](std::size_t i, const SlopeSpread& spread, EvidenceSum& sum) {
        if (modules[i].bin_count() == 1) return;
        const Coefficients mean = bin_prior(modules[i], counts[i].whole_fit, spread).mean;
        for (const Regression& fit : modules[i].bins) sum.add(fit, mean, spread);
      });
  return modules;
}

}  // namespace floe

#include "reco/compare.h"

#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "reco/direct_fit/design.h"
#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/event_data.h"

namespace floe {
namespace {

constexpr int repeats = 4;                                      // independent simulations of each fit
constexpr std::uint64_t first_stream = std::uint64_t{1} << 43;  // beyond those of the fits

Progress part(const Progress& progress, double from, double to, const std::string& label) {
  if (!progress) return {};
  return [=](double fraction, const std::string& stage) {
    progress(from + (to - from) * fraction, label + ": " + stage);
  };
}

// Both fits with the same number of photons and the same random numbers, again and again.
void measure(const std::array<SimulatedLight*, 2>& light, const EventData& data, const FitOptions& options,
             ModelComparison& result) {
  const double photons = useful_photons(*light[0], result.fits[0].cascade, data, options.oversize,
                                        options.effort, {3, 4e6, 1.2e7});
  std::array<Evaluation, 2> values;
  for (std::size_t i = 0; i < 2; ++i) {
    values[i] = evaluate_cascade(*light[i], data, result.fits[i].cascade, photons, options.oversize, repeats,
                                 first_stream, options.model_error);
    for (const LightSample& sample : values[i].samples) result.fits[i].count_simulation(sample.propagated);
  }
  const Difference worse = difference(values[1], values[0]);
  result.delta_neg_llh = worse.value;
  result.delta_neg_llh_error = worse.error;
}

// Cables and efficiencies may differ: they are part of what is compared.
bool same_modules(const Detector& a, const Detector& b) {
  return std::equal(a.modules().begin(), a.modules().end(), b.modules().begin(), b.modules().end(),
                    [](const Module& m, const Module& n) {
                      return m.id == n.id && m.on == n.on && m.position == n.position;
                    });
}

}  // namespace

ModelComparison compare_models(const Model& a, const Model& b, const Event& event, const FitOptions& options,
                               const Progress& progress) {
  if (!same_modules(*a.detector, *b.detector))
    throw UsageError("compare: the two models have different modules (" + a.detector->name() + ", " +
                     b.detector->name() + "); give both the same with --detector");
  const EventData data(*a.detector, event, options.selection);
  ModelComparison result;
  result.event = event.id;

  SimulatedLight light_a(a, options.kind, options.seed, options.threads, pulse_delays(event));
  SimulatedLight light_b(b, options.kind, options.seed, options.threads, pulse_delays(event));
  result.fits[0] = fit_cascade(light_a, data, options, part(progress, 0, 0.5, "A"));
  FitOptions second = options;
  if (result.fits[0].usable()) second.start = result.fits[0].cascade;
  result.fits[1] = fit_cascade(light_b, data, second, part(progress, 0.5, 0.9, "B"));

  result.distance = distance_between(result.fits[0].cascade, result.fits[1].cascade);
  result.angle = angle_between(result.fits[0].cascade, result.fits[1].cascade);
  if (result.fits[0].cascade.energy > 0)
    result.energy_ratio = result.fits[1].cascade.energy / result.fits[0].cascade.energy;
  if (result.usable()) {
    if (progress) progress(0.9, "measuring both fits");
    measure({&light_a, &light_b}, data, options, result);
  }
  if (progress) progress(1, "done");
  return result;
}

}  // namespace floe

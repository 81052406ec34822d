#include "reco/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "data/base/error.h"
#include "propagation/engine/random.h"
#include "propagation/engine/simulator.h"
#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/information_bound.h"
#include "reco/direct_fit/instrumented_volume.h"
#include "reco/event_data.h"

namespace floe {
namespace {

constexpr double depth_inside = 50;  // of vertices, at least [m]
// Widened modules see one photon more than once, as real ones hardly do. Of so many times the light one hit
// in so many is kept, which leaves a share of that.
constexpr double thinning = 4;
constexpr std::uint64_t data_stream = std::uint64_t{1} << 50;  // far from those of fits

// What tells events of a study apart.
std::uint64_t key_of(double energy, int index) {
  return static_cast<std::uint64_t>(std::llround(1000 * std::log10(energy))) * 1000000 +
         static_cast<std::uint64_t>(index);
}

bool is_contained(const InstrumentedVolume& volume, const Vec3& place) {
  constexpr int sides = 12;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides;
    if (volume.distance_outside(place + depth_inside * Vec3(std::cos(angle), std::sin(angle), 0)) > 0)
      return false;
  }
  return volume.distance_outside(place + Vec3(0, 0, depth_inside)) <= 0 &&
         volume.distance_outside(place - Vec3(0, 0, depth_inside)) <= 0;
}

Event simulate_event(const StudySettings& settings, const StudyGroup& group, const StudyRow& row,
                     int threads) {
  const Simulator simulator(settings.truth, group.oversize);
  const CascadeSource source(to_cascade(row.truth, settings.fit.kind), settings.truth.acceptance.spectrum);
  SimulationOptions options;
  options.seed = settings.seed;
  options.stream = data_stream + key_of(group.energy, row.index);
  options.threads = threads;
  options.scale = thinning;
  RandomStream kept(settings.seed, 0x7468696e, key_of(group.energy, row.index));
  Event event;
  event.id = fmt::format("study {:g} GeV {}", group.energy, row.index);
  simulator.run(source, options, [&](std::span<const SimulatedHit> hits) {
    for (const SimulatedHit& hit : hits)
      if (kept.uniform() * thinning < 1) event.hits.push_back(to_hit(hit, *settings.truth.detector));
  });
  return event;
}

StudyFit summary_of(const CascadeFit& fit) {
  return {fit.status, fit.reason,  fit.cascade, fit.covariance, fit.neg_llh,
          fit.ndof,   fit.p_value, fit.photons, fit.seconds,    fit.other_minimum};
}

}  // namespace

CascadeParameters draw_contained_cascade(const Detector& detector, std::uint64_t seed, double energy,
                                         int index) {
  const InstrumentedVolume volume(detector);
  const Detector::Extent extent = detector.extent();
  RandomStream random(seed, 0x7374756479, key_of(energy, index));
  CascadeParameters truth;
  truth.energy = energy;
  for (int i = 0; i < 10000; ++i) {
    for (int k = 0; k < 3; ++k)
      truth.position(k) = extent.low(k) + random.uniform() * (extent.high(k) - extent.low(k));
    if (is_contained(volume, truth.position)) {
      truth.time = 1000 * random.uniform();
      truth.zenith = std::acos(1 - 2 * random.uniform());
      truth.azimuth = 2 * pi * random.uniform();
      return truth;
    }
  }
  throw UsageError("study: the detector is too small to contain cascades 50 m inside its border");
}

StudyRow study_event(const StudySettings& settings, const StudyGroup& group, int index, int threads) {
  StudyRow row;
  row.energy = group.energy;
  row.index = index;
  row.truth = draw_contained_cascade(*settings.truth.detector, settings.seed, group.energy, index);
  const Event photons = simulate_event(settings, group, row, threads);
  const Event event = settings.response ? settings.response->respond(photons, {}, threads).event : photons;
  std::set<ModuleId> modules;
  for (const Hit& hit : event.hits) {
    row.charge += hit.charge;
    modules.insert(hit.module);
  }
  row.modules = modules.size();

  FitOptions options = settings.fit;
  options.oversize = group.oversize;
  options.seed = settings.seed * 1000003 + key_of(group.energy, index);
  options.threads = threads;
  options.data_widened = 1 / thinning;
  options.goodness = false;  // the study judges results by their truth
  if (settings.other) {
    const ModelComparison comparison = compare_models(settings.truth, *settings.other, event, options);
    row.fit = summary_of(comparison.fits[0]);
    row.other = summary_of(comparison.fits[1]);
    row.delta_neg_llh = comparison.delta_neg_llh;
    row.delta_neg_llh_error = comparison.delta_neg_llh_error;
  } else {
    row.fit = summary_of(fit_cascade(settings.truth, event, options));
  }
  SimulatedLight light(settings.truth, options.kind, options.seed ^ 0x626f756e64, threads);
  row.bound = cramer_rao_bound(light, row.truth,
                               EventData(*settings.truth.detector, photons, options.selection), options);
  return row;
}

}  // namespace floe

#include "reco/direct_fit/cascade_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "data/base/error.h"
#include "reco/direct_fit/alike_places.h"
#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/direct_fit/information_bound.h"
#include "reco/direct_fit/instrumented_volume.h"
#include "reco/direct_fit/one_string.h"
#include "reco/direct_fit/search.h"
#include "reco/direct_fit/seed.h"
#include "reco/direct_fit/track_test.h"

namespace floe {
namespace {

constexpr double outside_by = 60;                                    // from the instrumented volume [m]
constexpr int evaluations = 3;                                       // independent simulations of the result
constexpr std::uint64_t evaluation_stream = std::uint64_t{1} << 40;  // beyond those of the search
constexpr std::size_t pictured_modules = 12;
// Of weights that are noise, or of the emulator's curvature, errors come out too small: the Cramer-Rao bound
// has simulations of its own.
constexpr double trusted_loss = 1.5;

void check(const FitOptions& o) {
  const auto need = [](bool valid, const std::string& what) {
    if (!valid) throw UsageError("cascade fit: " + what);
  };
  need(o.oversize >= 1 && o.oversize <= 100, "oversize must be 1 to 100");
  need(o.model_error >= 0 && o.model_error <= 2, "model error must be 0 to 2");
  need(o.data_widened >= 0 && o.data_widened <= 1, "the share of widened data must be 0 to 1");
  need(std::isfinite(o.effort) && o.effort > 0, "effort must be above 0");
  need(o.sky_map_pixels == 0 || (o.sky_map_pixels >= 3 && o.sky_map_pixels % 2 == 1),
       "pixels of a sky map must be 0, or odd from 3 on");
  need(o.threads >= 0, "the number of threads must not be negative");
  need(!o.start || (o.start->energy > 0 && to_vector(*o.start).allFinite()), "the start must be a cascade");
}

// Measured and expected charge against time, of one event.
ArrivalTimes arrival_times(const EventData& data, const ModuleData& lit, const Evaluation& evaluation,
                           double vertex_time) {
  constexpr std::size_t most_bins = 150;
  ArrivalTimes result;
  result.module = data.detector().modules()[lit.module].id;
  result.measured_charge = lit.charge / data.repeats();
  result.begin = 25 * std::floor((lit.times.front() - 60) / 25);
  double seen = 0, last = lit.times.back();  // until nearly all charge has come
  for (std::size_t i = 0; i < lit.times.size() && seen < 0.97 * lit.charge; ++i)
    seen += lit.charges[i], last = lit.times[i];
  while ((last - result.begin) / result.step > double(most_bins)) result.step *= 2;
  const auto n = static_cast<std::size_t>((last - result.begin) / result.step) + 4;
  result.measured.assign(n, 0);
  result.expected.assign(n, 0);
  const auto add = [&](std::vector<double>& bins, double time, double charge) {
    const double place = std::floor((time - result.begin) / result.step);
    if (place >= 0 && place < double(n)) bins[static_cast<std::size_t>(place)] += charge;
  };
  for (std::size_t i = 0; i < lit.times.size(); ++i)
    add(result.measured, lit.times[i], lit.charges[i] / data.repeats());
  for (const LightSample& sample : evaluation.samples) {
    const double weight = 1 / (sample.repeats * double(evaluation.samples.size()));
    result.expected_charge += weight * double(sample.count(lit.module));
    for (const float* time = sample.begin(lit.module); time != sample.end(lit.module); ++time)
      add(result.expected, *time + vertex_time, weight);
  }
  return result;
}

void measure_goodness(const Evaluation& evaluation, const EventData& data, const FitOptions& options,
                      CascadeFit& fit) {
  fit.bins = evaluation.bins.size();
  fit.neg_llh = evaluation.neg_llh;
  fit.neg_llh_error = jackknife_error(evaluation.leave_one_out);
  const PseudoLikelihood pseudo =
      draw_pseudo_data(evaluation.bins, options.model_error, data.charge_dispersion(), options.seed);
  fit.ndof = 2 * pseudo.mean - 7;
  fit.p_value = 0.5 * std::erfc((fit.neg_llh - 0.5 * fit.ndof) / (pseudo.spread * std::sqrt(2.0)));
}

std::string outside_words(double metres) {
  return "the vertex is " + std::to_string(std::lround(metres)) + " m outside the instrumented volume";
}

void judge(const Search::End& end, const EventData& data, const TrackTest& track, bool with_energy,
           CascadeFit& fit) {
  const double outside = InstrumentedVolume(data.detector()).distance_outside(fit.cascade.position);
  if (!end.converged || !with_energy) {
    fit.status = FitStatus::no_convergence;
    fit.reason = "no convergence after " + std::to_string(fit.rounds.size()) +
                 " rounds: " + (end.converged ? "the data do not determine the energy" : end.trouble);
    // The likely cause, where there is one.
    if (track.track_like) fit.reason += "; the event looks like a track: " + track.words();
    if (outside > outside_by) fit.reason += "; " + outside_words(outside);
  } else if (outside > outside_by) {
    fit.status = FitStatus::outside;
    fit.reason = outside_words(outside);
  } else if (track.track_like) {
    fit.status = FitStatus::track_like;
    fit.reason = "the event looks like a track, the fit as a cascade may mean little: " + track.words();
  } else {
    fit.status = FitStatus::ok;
  }
}

// What only some users ask for.
void look_around(const Search::End& end, const FitOptions& options, CascadeFit& fit) {
  if (options.sky_map_pixels == 0 && !options.profile) return;
  const std::optional<ScoreLikelihood> likelihood = end.likelihood();
  if (!likelihood) return;
  if (options.sky_map_pixels > 0) {
    fit.sky_map = make_sky_map(*likelihood, options.sky_map_pixels, options.threads);
    fit.sky_map->errors_are_wider = fit.errors_beyond_likelihood;
  }
  if (options.profile) fit.profile = profile_intervals(*likelihood, options.kind);
}

void find_result(ExpectationModel& light, const EventData& data, const FitOptions& options, CascadeFit& fit,
                 const Progress& progress) {
  const MeanIce ice(*light.model().ice);
  const PointSeed point = find_point(data, ice);
  const TrackTest track = test_for_track(data, point);
  Search search(light, data, ice, options, fit, progress);
  const Search::End end = options.start ? search.from(*options.start) : search.from_scratch(point);

  fit.cascade = cascade_of(end.light, options.kind);
  const Matrix7 jacobian = LocalFrame(end.light).jacobian(Vector7::Zero(), options.kind);
  fit.covariance = jacobian * end.covariance * jacobian.transpose();
  if (end.simulation_covariance)
    fit.simulation_errors =
        (jacobian * *end.simulation_covariance * jacobian.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  const Matrix7 of_likelihood = fit.covariance;
  if (end.converged && end.weight_loss() > trusted_loss) {
    const Matrix7 bound = cramer_rao_bound(light, fit.cascade, data, options, &fit);
    fit.covariance = no_less_than(data.charge_dispersion() * bound, fit.covariance);
  }
  const bool with_energy = determines_energy(fit.covariance, fit.cascade.energy);
  if (const std::optional<Vec3> axis = axis_of_only_string(data); axis && end.converged) {
    if (progress) progress(0.9, "looking around the string");
    const double photons = search.photons_for(fit.cascade, options.oversize, {3, 1e6, 2e6});
    const std::vector<AlikePlace> places = alike_places(light, data, *axis, options, photons, fit);
    fit.covariance =
        with_alike_places(with_arc_about(*axis, fit.cascade, fit.covariance), fit.cascade, *axis, places);
  }
  if (fit.other_minimum) fit.covariance = with_other_minimum(fit.covariance, fit.cascade, *fit.other_minimum);

  fit.errors_beyond_likelihood = fit.covariance != of_likelihood;

  judge(end, data, track, with_energy, fit);
  look_around(end, options, fit);
  if (!options.goodness) return;
  if (progress) progress(0.92, "measuring the fit");
  const double photons = search.photons_for(fit.cascade, options.oversize, {3, 4e6, 5e6});
  const Evaluation evaluation =
      evaluate_cascade(light, end.edges.empty() ? data : data.with_edges(end.edges), fit.cascade, photons,
                       options.oversize, evaluations, evaluation_stream, options.model_error);
  for (const LightSample& sample : evaluation.samples) fit.count_simulation(sample.propagated);
  measure_goodness(evaluation, data, options, fit);
  for (const std::size_t i : data.brightest(pictured_modules))
    fit.arrival_times.push_back(arrival_times(data, data.lit()[i], evaluation, fit.cascade.time));
}

}  // namespace

bool determines_energy(const Matrix7& covariance, double energy) {
  return covariance(6, 6) < energy * energy;
}

std::string name_of(FitStatus status) {
  switch (status) {
    case FitStatus::ok:
      return "ok";
    case FitStatus::track_like:
      return "track_like";
    case FitStatus::outside:
      return "outside";
    case FitStatus::no_convergence:
      return "no_convergence";
    case FitStatus::not_enough_light:
      return "not_enough_light";
  }
  return "";
}

Matrix7 CascadeFit::covariance_in_degrees() const {
  Vector7 unit = Vector7::Ones();
  unit(4) = unit(5) = 1 / degree;
  return unit.asDiagonal() * covariance * unit.asDiagonal();
}

CascadeFit fit_cascade(const Model& model, const Event& event, const FitOptions& options,
                       const Progress& progress) {
  check(options);
  const EventData data(*model.detector, event, options.selection);
  SimulatedLight light(model, options.kind, options.seed, options.threads, pulse_delays(event));
  return fit_cascade(light, data, options, progress);
}

CascadeFit fit_cascade(ExpectationModel& light, const EventData& data, const FitOptions& options,
                       const Progress& progress) {
  check(options);
  const auto start = std::chrono::steady_clock::now();
  CascadeFit fit;
  fit.kind = options.kind;
  fit.ice_name = light.model().ice->name();
  fit.ice_hash = light.model().ice->hash();
  fit.bins = data.bins();
  try {
    data.require_enough_light();
    find_result(light, data, options, fit, progress);
  } catch (const NoResult& none) {
    fit.status = FitStatus::not_enough_light;
    fit.reason = none.what();
  }
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress) progress(1, "done");
  return fit;
}

std::string describe(const CascadeFit& fit) {
  std::string text = name_of(fit.status) + (fit.reason.empty() ? "" : ": " + fit.reason) + "\n";
  if (fit.status == FitStatus::not_enough_light) return text;
  const Vector7 value = to_vector(fit.cascade);
  for (int i = 0; i < 7; ++i) {
    const ShownParameter& shown = shown_parameters[static_cast<std::size_t>(i)];
    const double variance = fit.covariance(i, i);
    char error[40] = "?";  // the data leave it open
    if (variance >= 0)
      std::snprintf(error, sizeof error, "%.*f", shown.digits, std::sqrt(variance) / shown.unit_size);
    char line[120];
    std::snprintf(line, sizeof line, "  %-8s %10.*f +- %s %s\n", shown.name, shown.digits,
                  value(i) / shown.unit_size, error, shown.unit);
    text += line;
  }
  if (fit.other_minimum) text += describe(*fit.other_minimum);
  if (fit.profile) text += describe(*fit.profile);
  if (fit.sky_map) text += describe(*fit.sky_map);
  if (fit.errors_beyond_likelihood && (fit.profile || fit.sky_map))
    text +=
        "  Profile and map know this minimum alone; the errors above also know where else the truth may be\n";
  char line[200];
  std::snprintf(line, sizeof line,
                "  -ln L %.1f +- %.1f (pseudo-data: %.1f), p = %.3g; %zu simulations, %.3g photons, %.0f s\n",
                fit.neg_llh, fit.neg_llh_error, 0.5 * fit.ndof, fit.p_value,
                static_cast<std::size_t>(fit.simulations), double(fit.photons), fit.seconds);
  return text + line;
}

}  // namespace floe

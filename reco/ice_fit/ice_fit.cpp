#include "reco/ice_fit/ice_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "data/base/error.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/ice_solution.h"
#include "reco/ice_fit/receiver_efficiencies.h"
#include "reco/ice_fit/run_light.h"
#include "reco/ice_fit/run_likelihood.h"
#include "reco/ice_fit/run_plan.h"
#include "reco/ice_fit/score_system.h"

namespace floe {

namespace {

constexpr double longest_step = 0.7;  // of a round, in the parameter's scale
// Two steps so small, in their errors, are the last: root mean square and largest. New simulations in every
// round keep them from getting much smaller; one step alone may be small by chance, on its way.
constexpr double settled = 0.8, settled_most = 2.5;
// Far from the streams of simulated data.
constexpr std::uint64_t first_stream = std::uint64_t{1} << 40;
constexpr std::uint64_t streams_a_run = 1 << 10, streams_a_round = 1 << 20;

// What is known of a run between rounds.
struct RunState {
  double hits_per_photon = 0;  // simulated, of used receivers
  double brightness = 0;       // N of all flashes together; 0: not yet known
  double time_zero = 0;        // [ns]
  RunBins bins;
  RunLight seen;  // of the rounds from the second on, in these bins
};

void check(const IceFitOptions& options) {
  check(static_cast<const RunSettings&>(options));
  if (!(options.smoothness > 0 && options.amplitude > 0))
    throw UsageError("the widths of priors must be positive");
  if (!(options.efficiency_width >= 0 && options.efficiency_width <= 1))
    throw UsageError("the width of efficiencies must be from 0 to 1");
  if (!(options.pair_light > 0)) throw UsageError("pairs of simulations need light");
  if (!(options.first_light > 0)) throw UsageError("the first round needs light");
  if (options.most_rounds < 1) throw UsageError("a fit needs at least one round");
}

// Hits with the run's time zero.
SimulatedRun simulate(const Model& model, const RunRequest& request, double time_zero) {
  SimulatedRun run = simulate_run(model, request);
  delay(run, time_zero);
  return run;
}

class Fit {
 public:
  Fit(const Model& base, FlasherData data, const std::vector<IceParameter>& parameters,
      const IceFitOptions& options, const Progress& progress)
      : base_(base),
        data_(std::move(data)),
        options_(options),
        progress_(progress),
        states_(data_.runs.size()) {
    fit_.parameters = parameters;
    for (const IceParameter& parameter : parameters) fit_.numbers.push_back(parameter.start);
  }

  IceFit run() {
    look_first();
    for (round_ = 1; round_ <= options_.most_rounds && !fit_.converged && !is_settled(); ++round_)
      one_round();
    fit_.rounds = round_ - 1;
    if (options_.judged) judge();
    return std::move(fit_);
  }

 private:
  // Before the round that comes. The first may have been far from the data.
  bool is_settled() const { return options_.settled && round_ > 2 && options_.settled(fit_); }

  std::size_t count() const { return fit_.parameters.size(); }
  Model model() const { return with_parameters(base_, fit_.parameters, fit_.numbers); }

  RunRequest request(std::size_t r, std::uint64_t purpose, double photons) const {
    return request_of(
        data_.runs[r], options_, photons,
        first_stream + static_cast<std::uint64_t>(round_) * streams_a_round + r * streams_a_run + purpose,
        states_[r].brightness);
  }

  // How much light of each run is seen, in the starting model, and which receivers cannot be right.
  void look_first() {
    const FirstLook look = floe::look_first(
        model(), [this](std::size_t r, double photons) { return request(r, 0, photons); }, data_);
    fit_.photons += look.propagated;
    fit_.left_out = data_.left_out;
    for (std::size_t r = 0; r < states_.size(); ++r) {
      states_[r].hits_per_photon = look.hits_per_photon[r];
      states_[r].brightness = look.brightness[r];
    }
  }

  double photons_of(std::size_t r) const {
    return photons_wanted(data_.runs[r], states_[r].hits_per_photon, options_.light);
  }

  RunBins bins_of(const Model& model, std::size_t r) {
    const Scout scout = scout_run(model, request(r, 1, photons_of(r)), states_[r].time_zero);
    fit_.photons += scout.simulated.propagated;
    return floe::bins_of(scout, data_.runs[r], states_[r].brightness);
  }

  void one_round() {
    const IcePoint point(base_, fit_.parameters, fit_.numbers,
                         data_.runs.front().run.wavelength);  // all have the same
    const auto runs = states_.size();
    // The first round may be far from the data; from the second one on, bins stay and slopes gather.
    if (round_ <= 2)
      for (std::size_t r = 0; r < runs; ++r) states_[r].bins = bins_of(point.model(), r);
    const EfficiencyColumns efficiencies = efficiency_columns();
    ScoreSystem system(static_cast<int>(count() + 2 * runs) + efficiencies.count());
    for (std::size_t r = 0; r < runs; ++r) {
      report(r, "walking in the light of");
      add_run_to(point, r, efficiencies, system);
    }
    calibrate_information(groups(), system);
    const ProfiledSystem profiled =
        profile_efficiencies(system, efficiencies.count(), options_.efficiency_width);
    const IceSolution solution = solve_ice(profiled.system, fit_.parameters, fit_.numbers,
                                           {options_.smoothness, options_.amplitude}, longest_step);
    note_efficiencies(efficiencies, profiled, solution.step);
    double furthest = 0, squares = 0;
    const double share = physical_share(solution.step);
    const std::vector<double> before = fit_.numbers;
    for (std::size_t p = 0; p < count(); ++p) {
      const auto i = static_cast<Eigen::Index>(p);
      fit_.numbers[p] += share * solution.step(i);
      const double pull = std::abs(solution.step(i)) / std::sqrt(solution.covariance(i, i));
      furthest = std::max(furthest, pull);
      squares += pull * pull;
    }
    for (std::size_t r = 0; r < runs; ++r) {
      const auto i = static_cast<Eigen::Index>(count() + 2 * r);
      states_[r].brightness *= std::exp(solution.step(i));
      states_[r].time_zero += solution.step(i + 1);
    }
    fit_.covariance = solution.covariance;
    fit_.light_errors = solution.light_errors;
    const double mean = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, count())));
    const bool small = mean < settled && furthest < settled_most;
    fit_.converged = small && small_before_;
    small_before_ = small;
    // Where they end differs by the noise of their simulations alone: the middle has less of it.
    if (fit_.converged)
      for (std::size_t p = 0; p < count(); ++p) fit_.numbers[p] = (before[p] + fit_.numbers[p]) / 2;
  }

  // How much of a step leads to ice that can be: crystals must not scatter more than their layer does.
  double physical_share(const Eigen::VectorXd& step) const {
    constexpr double least = 1.0 / 64;
    for (double share = 1;; share /= 2) {
      std::vector<double> numbers = fit_.numbers;
      for (std::size_t p = 0; p < count(); ++p) numbers[p] += share * step(static_cast<Eigen::Index>(p));
      try {
        with_parameters(base_, fit_.parameters, numbers);
        return share;
      } catch (const InputError&) {
        if (share <= least) throw;
      }
    }
  }

  // By column of the system's parameters: families, and each parameter that has none.
  std::vector<std::string> groups() const {
    std::vector<std::string> names;
    for (const IceParameter& p : fit_.parameters) names.push_back(p.family.empty() ? p.name : p.family);
    return names;
  }

  EfficiencyColumns efficiency_columns() const {
    if (options_.efficiency_width == 0) return {};
    std::vector<const RunBins*> bins;
    for (const RunState& state : states_) bins.push_back(&state.bins);
    return {bins, static_cast<int>(count() + 2 * states_.size())};
  }

  void note_efficiencies(const EfficiencyColumns& columns, const ProfiledSystem& profiled,
                         const Eigen::VectorXd& step) {
    fit_.efficiencies.clear();
    if (columns.count() == 0) return;
    constexpr double least = 0.01;  // a module that is dead has no efficiency below this
    const Eigen::VectorXd changes = profiled.changes(step);
    for (std::size_t i = 0; i < columns.modules().size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      fit_.efficiencies.push_back({base_.detector->modules()[columns.modules()[i]].id,
                                   std::max(least, 1 + changes(at)), profiled.errors(at)});
    }
  }

  void add_run_to(const IcePoint& point, std::size_t r, const EfficiencyColumns& efficiencies,
                  ScoreSystem& system) {
    const RunData& run = data_.runs[r];
    RunState& state = states_[r];
    const double photons = (round_ == 1 ? options_.first_light : 1) * photons_of(r);
    const RunBins& bins = state.bins;
    const RunRequest request = this->request(r, 2, photons);
    const SimulatedRun simulated = simulate(point.model(), request, state.time_zero);
    auto [light, propagated] =
        point.light(request, simulated, bins, state.time_zero,
                    {.light = options_.pair_light, .least_hits = options_.least_pair_hits});
    fit_.photons += simulated.propagated + propagated;

    const double hits = used_hits(simulated, run);
    state.hits_per_photon = std::max(1.0, hits) / photons;
    RunCounts counts;
    counts.data = run.counts(bins);
    counts.scale = state.brightness / light.photons;
    counts.dispersion = dispersion(simulated);
    counts.data_dispersion = (run.run.oversize > 1 ? counts.dispersion : 1) * run.charge_dispersion;
    counts.model_error = options_.model_error;
    RunColumns columns{static_cast<int>(count() + 2 * r), efficiencies.of_receivers(bins), {}};
    if (efficiencies.count() > 0) columns.receiver_of_bin = bins.receiver_of_bin();
    if (round_ <= 2) {
      add_run(light, light, counts, columns, system);
      state.seen = std::move(light);
    } else {
      add_run(light, state.seen, counts, columns, system);
      for (int fold = 0; fold < 2; ++fold) state.seen.folds[fold] += light.folds[fold];
    }
  }

  Model with_efficiencies(const Model& model) const {
    if (fit_.efficiencies.empty()) return model;
    ModelParts parts = parts_of(model);
    std::vector<Module> modules = parts.detector.modules();
    for (const ReceiverEfficiency& receiver : fit_.efficiencies)
      modules[parts.detector.index_of(receiver.module)].relative_efficiency *= receiver.factor;
    parts.detector = Detector(parts.detector.name(), std::move(modules), parts.detector.strings());
    return freeze(std::move(parts));
  }

  // Fresh simulations say how well the result fits.
  void judge() {
    const Model model = with_efficiencies(this->model());
    for (std::size_t r = 0; r < states_.size(); ++r) {
      report(r, "measuring the fit to");
      const RunData& run = data_.runs[r];
      const RunBins bins = bins_of(model, r);
      const double photons = photons_of(r);
      const SimulatedRun simulated = simulate(model, request(r, 2, photons), states_[r].time_zero);
      fit_.photons += simulated.propagated;
      // Its hits have the time zero already.
      const RunMeasurement measured =
          measure_run(simulated, photons, run, bins, {states_[r].brightness, 0}, options_.model_error);
      const RunResult result{run.name, measured.nuisances.brightness / run.repeats,
                             states_[r].time_zero + measured.nuisances.time_zero, measured.neg_llh,
                             measured.bins};
      fit_.neg_llh += result.neg_llh;
      fit_.bins += result.bins;
      fit_.runs.push_back(result);
    }
  }

  void report(std::size_t r, const char* what) const {
    if (!progress_) return;
    const double rounds = options_.most_rounds + 1, runs = static_cast<double>(states_.size());
    progress_((round_ - 1 + static_cast<double>(r) / runs) / rounds,
              fmt::format("round {}: {} {}", round_, what, data_.runs[r].name));
  }

  const Model& base_;
  FlasherData data_;
  const IceFitOptions& options_;
  const Progress& progress_;
  std::vector<RunState> states_;
  int round_ = 0;
  bool small_before_ = false;  // whether the step of the round before was
  IceFit fit_;
};

}  // namespace

double IceFit::value(std::size_t i) const {
  return parameters[i].logarithmic ? std::exp(numbers[i]) : numbers[i];
}

double IceFit::error(std::size_t i) const {
  const auto k = static_cast<Eigen::Index>(i);
  const double error = std::sqrt(covariance(k, k));
  return parameters[i].logarithmic ? value(i) * error : error;
}

double IceFit::distance(std::size_t first, std::span<const double> from) const {
  const auto at = static_cast<Eigen::Index>(first), size = static_cast<Eigen::Index>(from.size());
  Eigen::VectorXd off(size);
  for (Eigen::Index i = 0; i < size; ++i)
    off(i) = numbers[first + static_cast<std::size_t>(i)] - from[static_cast<std::size_t>(i)];
  return off.dot(covariance.block(at, at, size, size).ldlt().solve(off));
}

IceFit fit_ice(const Model& base, const FlasherData& data, const std::vector<IceParameter>& parameters,
               const IceFitOptions& options, const Progress& progress) {
  check(options);
  const auto start = std::chrono::steady_clock::now();
  IceFit fit = Fit(base, data, parameters, options, progress).run();
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return fit;
}

}  // namespace floe

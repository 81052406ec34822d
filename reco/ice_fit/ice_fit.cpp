#include "reco/ice_fit/ice_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "data/base/error.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/ice_solution.h"
#include "reco/ice_fit/receiver_efficiencies.h"
#include "reco/ice_fit/round_memory.h"
#include "reco/ice_fit/run_scores.h"
#include "reco/ice_fit/score_system.h"

namespace floe {

namespace {

constexpr double longest_step = 0.7;  // of a round, in the parameter's scale
// Two steps so small, in their errors, are the last: root mean square and largest. New simulations in every
// round keep them from getting much smaller; one step alone may be small by chance, on its way.
constexpr double settled = 0.8, settled_most = 2.5;
constexpr double linear = 4;  // of a step, in errors: scores change in proportion to it

void check(const IceFitOptions& options) {
  check(static_cast<const RunSettings&>(options));
  if (!(options.smoothness > 0 && options.amplitude > 0))
    throw UsageError("the widths of priors must be positive");
  if (!(options.efficiency_width >= 0 && options.efficiency_width <= 1))
    throw UsageError("the width of efficiencies must be from 0 to 1");
  if (options.remembers && options.efficiency_width > 0)
    throw UsageError("fits that remember their rounds know the receivers' efficiencies");
  if (!(options.pair_light > 0)) throw UsageError("pairs of simulations need light");
  if (!(options.first_light > 0 && options.later_light > 0)) throw UsageError("rounds need light");
  if (options.most_rounds < 1) throw UsageError("a fit needs at least one round");
}

// Of the parameters alone.
struct StepSize {
  double mean = 0, furthest = 0;  // root mean square and largest, in their errors
  bool is_small() const { return mean < settled && furthest < settled_most; }
};
StepSize size_of(const IceSolution& solution) {
  const Eigen::Index count = solution.covariance.rows();
  const Eigen::ArrayXd pulls =
      solution.step.head(count).array().abs() / solution.covariance.diagonal().array().sqrt();
  if (count == 0) return {};
  return {std::sqrt(pulls.square().mean()), pulls.maxCoeff()};
}

class Fit {
 public:
  Fit(const Model& base, FlasherData data, const std::vector<IceParameter>& parameters,
      const IceFitOptions& options, const Progress& progress)
      : base_(base), options_(options), progress_(progress), scores_(std::move(data), options) {
    fit_.parameters = parameters;
    for (const IceParameter& parameter : parameters) fit_.numbers.push_back(parameter.start);
  }

  IceFit run() {
    scores_.look_first(model(), /*runs_keep_numbers=*/false);
    fit_.left_out = scores_.left_out();
    for (round_ = 1; round_ <= options_.most_rounds && !fit_.converged && !is_settled(); ++round_)
      one_round();
    if (options_.judged) judge();
    fit_.photons = scores_.propagated();
    return std::move(fit_);
  }

  std::vector<FitWithout> run_without(const std::vector<std::vector<char>>& left_out) {
    scores_.look_first(model(), /*runs_keep_numbers=*/true);
    round_ = 1;
    one_round();
    ++round_;
    const IcePoint point = begin_round();
    std::vector<ScoreSystem> of_runs(scores_.count(), empty_system());
    for (std::size_t r = 0; r < of_runs.size(); ++r) {
      report(r, "walking in the light of");
      scores_.add(point, r, count(), {}, of_runs[r]);
    }
    std::vector<FitWithout> fits;
    for (const std::vector<char>& runs : left_out) {
      ScoreSystem kept = empty_system(), others = empty_system();
      for (std::size_t r = 0; r < of_runs.size(); ++r) (runs[r] ? others : kept) += of_runs[r];
      fits.push_back(fit_without(std::move(kept), std::move(others)));
    }
    return fits;
  }

 private:
  // Before the round that comes. The first may have been far from the data.
  bool is_settled() const { return options_.settled && round_ > 2 && options_.settled(fit_); }

  std::size_t count() const { return fit_.parameters.size(); }
  Model model() const { return with_parameters(base_, fit_.parameters, fit_.numbers); }

  IcePoint begin_round() {
    IcePoint point(base_, fit_.parameters, fit_.numbers, scores_.wavelength());
    scores_.begin_round(point.model());
    return point;
  }
  ScoreSystem empty_system(int efficiencies = 0) const {
    return ScoreSystem(static_cast<int>(count() + 2 * scores_.count()) + efficiencies);
  }

  // Where one step leads. What none of the runs that are kept tells goes all the way to its prior.
  FitWithout fit_without(ScoreSystem kept, ScoreSystem others) const {
    constexpr double any = std::numeric_limits<double>::infinity();
    calibrate(kept), calibrate(others);
    const IceSolution solution =
        solve_ice(kept, fit_.parameters, fit_.numbers, {options_.smoothness, options_.amplitude}, any);
    const Eigen::MatrixXd information = information_about_ice(others, static_cast<Eigen::Index>(count()));
    FitWithout fit;
    try {
      fit.numbers = stepped(solution.step);
    } catch (const InputError&) {
      return fit;  // the step leads to no physical ice
    }
    Eigen::VectorXd change(information.rows());
    for (std::size_t p = 0; p < count(); ++p)
      change(static_cast<Eigen::Index>(p)) = (*fit.numbers)[p] - fit_.numbers[p];
    fit.unknown =
        std::min(information.cwiseProduct(solution.covariance).sum(), change.dot(information * change));
    return fit;
  }

  void one_round() {
    const IcePoint point = begin_round();
    const EfficiencyColumns efficiencies =
        scores_.efficiency_columns(static_cast<int>(count() + 2 * scores_.count()));
    ScoreSystem system = empty_system(efficiencies.count());
    for (std::size_t r = 0; r < scores_.count(); ++r) {
      report(r, "walking in the light of");
      scores_.add(point, r, count(), efficiencies, system);
    }
    // The first round is far from where the others are.
    if (options_.remembers && round_ > 1) system = memory_.with(system);
    calibrate(system);
    const ProfiledSystem profiled =
        profile_efficiencies(system, efficiencies.count(), options_.efficiency_width);
    const IceSolution solution = solve_ice(profiled.system, fit_.parameters, fit_.numbers,
                                           {options_.smoothness, options_.amplitude}, longest_step);
    note_efficiencies(efficiencies, profiled, solution.step);
    const std::vector<double> before = std::exchange(fit_.numbers, stepped(solution.step));
    scores_.step_nuisances(solution.step, count());
    const StepSize size = size_of(solution);
    fit_.covariance = solution.covariance;
    fit_.light_errors = solution.light_errors;
    fit_.rounds = round_;
    if (options_.remembers) {
      remember(before, solution.step, size);
      return;  // its steps get small whether or not they have arrived
    }
    fit_.converged = size.is_small() && small_before_;
    small_before_ = size.is_small();
    // Where they end differs by the noise of their simulations alone: the middle has less of it.
    if (fit_.converged)
      for (std::size_t p = 0; p < count(); ++p) fit_.numbers[p] = (before[p] + fit_.numbers[p]) / 2;
  }

  // By how much the fit has gone on: parameters as far as they went, nuisances all of the step.
  void remember(const std::vector<double>& before, Eigen::VectorXd step, const StepSize& size) {
    if (size.furthest > linear || !scores_.is_short(step, count())) {
      memory_.forget();
      return;
    }
    for (std::size_t p = 0; p < count(); ++p)
      step(static_cast<Eigen::Index>(p)) = fit_.numbers[p] - before[p];
    memory_.move(step);
  }

  // As much of a step as leads to ice that can be: crystals must not scatter more than their layer does.
  std::vector<double> stepped(const Eigen::VectorXd& step) const {
    constexpr double least = 1.0 / 64;
    for (double share = 1;; share /= 2) {
      std::vector<double> numbers;
      for (std::size_t p = 0; p < count(); ++p)
        numbers.push_back(
            fit_.parameters[p].within(fit_.numbers[p] + share * step(static_cast<Eigen::Index>(p))));
      try {
        with_parameters(base_, fit_.parameters, numbers);
        return numbers;
      } catch (const InputError&) {
        if (share <= least) throw;
      }
    }
  }

  // Information that is noise of the slopes is taken out: of combinations of parameters at one place, and of
  // families, places, and each parameter that has neither.
  void calibrate(ScoreSystem& system) const {
    std::vector<std::string> places, groups;
    for (const IceParameter& p : fit_.parameters) {
      places.push_back(p.place);
      groups.push_back(!p.family.empty() ? p.family : !p.place.empty() ? p.place : p.name);
    }
    shrink_combinations(places, system);
    calibrate_information(groups, system);
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
    scores_.begin_judging();
    for (std::size_t r = 0; r < scores_.count(); ++r) {
      report(r, "measuring the fit to");
      fit_.runs.push_back(scores_.judge(model, r));
      fit_.neg_llh += fit_.runs.back().neg_llh;
      fit_.bins += fit_.runs.back().bins;
    }
  }

  void report(std::size_t r, const char* what) const {
    if (!progress_) return;
    const double rounds = options_.most_rounds + 1, runs = static_cast<double>(scores_.count());
    progress_((round_ - 1 + static_cast<double>(r) / runs) / rounds,
              fmt::format("round {}: {} {}", round_, what, scores_.name(r)));
  }

  const Model& base_;
  const IceFitOptions& options_;
  const Progress& progress_;
  RunScores scores_;
  int round_ = 0;
  bool small_before_ = false;  // whether the step of the round before was
  RoundMemory memory_;
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

std::vector<FitWithout> fit_ice_without(const Model& base, const FlasherData& data,
                                        const std::vector<IceParameter>& parameters,
                                        const std::vector<std::vector<char>>& left_out, IceFitOptions options,
                                        const Progress& progress) {
  check(options);
  if (options.efficiency_width > 0)
    throw UsageError("fits that leave runs out know the receivers' efficiencies");
  options.most_rounds = 2;
  return Fit(base, data, parameters, options, progress).run_without(left_out);
}

}  // namespace floe

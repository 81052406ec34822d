// Fits parameters of the ice to flasher data: every layer's absorption, scattering, birefringence at once.
// Theory: docs/theory/ice_fit.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/model.h"
#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

struct IceFit;

struct IceFitOptions : RunSettings {
  double smoothness = 0.5;  // prior: width of the difference between neighbouring layers, in the logarithm
  double amplitude = 1;     // prior: width of each parameter about where it began, in the logarithm
  // Prior: width of each receiver's relative efficiency about the model's, all of them fitted along; 0:
  // known.
  double efficiency_width = 0;
  // Of the simulations of slopes that weights of paths cannot give, in units of a run's own.
  double pair_light = 1;
  double least_pair_hits = 0;  // see PairPlan
  // Of the first round, which only leads near to where the others go on, and of each later one, in units of
  // `light`.
  double first_light = 1, later_light = 1;
  // Rounds after the first are solved together with those before, moved to where the fit is; each adds its
  // light, and none is the last but `most_rounds`, unless `settled` says so.
  bool remembers = false;
  int most_rounds = 6;
  // Asked about the fit so far, from the second round on: whether what it was wanted for is settled. Empty:
  // it goes on until it has converged.
  std::function<bool(const IceFit&)> settled;
  bool judged = true;  // by fresh simulations at the end; without, IceFit::runs and neg_llh are missing
};

struct RunResult {
  std::string name;
  double brightness = 1;  // of a flash, in nominal photons N
  double time_zero = 0;   // [ns]
  double neg_llh = 0;     // limited-simulation likelihood (reco/likelihood), saturated
  int bins = 0;
};

// Of a module that received light, over the model's.
struct ReceiverEfficiency {
  ModuleId module;
  double factor = 1, error = 0;
};

struct IceFit {
  std::vector<IceParameter> parameters;
  std::vector<double> numbers;       // as IceParameter::apply takes them
  Eigen::MatrixXd covariance;        // of the numbers, data and simulation and priors together
  std::vector<double> light_errors;  // without the priors; infinite where the data say nothing
  std::vector<RunResult> runs;
  std::vector<ReceiverEfficiency> efficiencies;  // where they were fitted
  std::vector<std::string> left_out;             // of the data, a sentence each
  double neg_llh = 0;
  int bins = 0, rounds = 0;
  bool converged = false;
  double seconds = 0;
  std::uint64_t photons = 0;  // propagated

  double value(std::size_t i) const;  // as shown: exp() of logarithmic numbers
  double error(std::size_t i) const;  // of value()
  // Chi-square of the parameters from `first` on about other numbers, whatever the rest of them are (Wald).
  double distance(std::size_t first, std::span<const double> from) const;
};

// Gauss-Newton rounds: simulate every run in the current model, read slopes off the detected photons' paths,
// solve for the parameters (each run's brightness and time zero fitted along, efficiencies where they are
// asked for), until two steps are small or `settled`. Throws UsageError for options out of range, NoResult
// when no run has light to fit.
IceFit fit_ice(const Model& base, const FlasherData& data, const std::vector<IceParameter>& parameters,
               const IceFitOptions& options, const Progress& progress = {});

// A fit to some of the runs.
struct FitWithout {
  std::optional<std::vector<double>> numbers;  // none where its step leads to no physical ice
  // By how much the deviance (-2 ln L) of the runs that were left out is larger at these numbers because the
  // others leave them uncertain: d^T F d, with F what those runs tell and d the change from the fit to all
  // runs, and at most what it is on average, tr(F C), with C the covariance of the fit to the others.
  double unknown = 0;
};

// Fits that each leave some of the runs out, all from one simulation of every run: after a round of the fit
// to all of them, one Gauss-Newton step of the others' equations alone, of any length. To be begun where a
// fit to all runs has ended. `left_out`: by fit, by run. Throws as fit_ice does, InputError where the first
// round's way leads to no physical ice.
std::vector<FitWithout> fit_ice_without(const Model& base, const FlasherData& data,
                                        const std::vector<IceParameter>& parameters,
                                        const std::vector<std::vector<char>>& left_out, IceFitOptions options,
                                        const Progress& progress = {});

}  // namespace floe

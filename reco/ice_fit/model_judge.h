// Compares models of the ice by the same flasher data, in the same bins, with the same random numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_likelihood.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// Of -ln L of two simulations of equally good models with `light` times the data's light, in the same bins:
// half a chi-square of all bins each, of which the data, the same for both, make a share.
double variance_of_difference(Eigen::Index bins, double light);

class ModelJudge {
 public:
  // Bins and light are those of `base`. `data`: screened, of which `look` was taken; `stream`: the first of
  // three times as many as there are runs.
  ModelJudge(const Model& base, const FlasherData& data, const FirstLook& look, const RunSettings& settings,
             std::uint64_t stream);

  // -ln L of a run at its best brightness and time zero.
  RunMeasurement measure(const Model& model, std::size_t run) const;
  double neg_llh(const Model& model) const;  // of all runs
  // The same, and what it would be if the model were true: mean and standard deviation.
  struct Fit {
    RunMeasurement measured;
    double expected = 0, scatter = 0;  // -ln L
  };
  Fit judge(const Model& model, std::size_t run) const;
  std::vector<Fit> judge_all(const Model& model) const;  // by run
  // Standard deviation of the difference of -ln L, over all runs, of models that fit equally well: what their
  // simulations' noise makes.
  double noise_of_differences() const { return std::sqrt(squared_noise_); }

 private:
  RunRequest request(std::size_t run, std::uint64_t purpose, double photons) const;
  RunMeasurement measured(const SimulatedRun& simulated, std::size_t run) const;

  const FlasherData& data_;
  RunSettings settings_;
  std::uint64_t stream_;
  std::vector<double> brightness_;
  std::vector<double> photons_;
  std::vector<RunView> views_;
  double squared_noise_ = 0;
};

}  // namespace floe

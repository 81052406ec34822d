// The estimating equations of an ice fit, collected run by run.
#pragma once

#include <Eigen/Core>

#include "reco/ice_fit/run_light.h"

namespace floe {

// With weights w per bin and parameter that one half of a simulation suggests, and expectations mu of the
// other half,
//   gap   = sum_bins w (d - mu)              0 on average at the true parameters, whatever the weights
//   slope = sum_bins w d mu / d parameters   how fast it closes
//   noise = its covariance: Poisson noise of data and simulation.
// The best weights are d ln mu / d parameters, for which slope = noise = the Fisher information.
struct ScoreSystem {
  explicit ScoreSystem(int size)
      : gap(Eigen::VectorXd::Zero(size)),
        slope(Eigen::MatrixXd::Zero(size, size)),
        noise(Eigen::MatrixXd::Zero(size, size)) {}
  Eigen::VectorXd gap;
  Eigen::MatrixXd slope, noise;
};

struct RunCounts {
  Eigen::VectorXd data;   // counts per bin, of all flashes
  double scale = 1;       // expected counts of the data for one simulated hit of one fold
  double dispersion = 1;  // variance of counts in units of Poisson's: photons that are seen twice
  double data_dispersion = 1;
  double model_error = 0;
};

// Adds a run: parameters of the ice are the first columns, its brightness (logarithm) and time zero the two
// columns from `nuisance` on.
void add_run(const RunLight& light, const RunCounts& counts, int nuisance, ScoreSystem& system);

}  // namespace floe

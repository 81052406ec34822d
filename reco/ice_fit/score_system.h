// The estimating equations of an ice fit, collected run by run.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reco/ice_fit/run_light.h"

namespace floe {

// With weights w per bin and parameter that one half of a simulation suggests, and expectations mu of the
// other half,
//   gap         = sum_bins w (d - mu)             0 on average at the true parameters, whatever the weights
//   slope       = sum_bins w d mu/d parameters    how fast it closes, from the slopes as they are: noisy
//   information = sum_bins w mu w                 the same on average, if w is what the slopes probably are
//   noise       = covariance of the gap: Poisson noise of data and simulation.
// The best weights are d ln mu/d parameters, for which the last three are the Fisher information. The part of
// the noise that is the simulation's alone is kept beside it.
struct ScoreSystem {
  explicit ScoreSystem(int size)
      : gap(Eigen::VectorXd::Zero(size)),
        slope(Eigen::MatrixXd::Zero(size, size)),
        information(Eigen::MatrixXd::Zero(size, size)),
        noise(Eigen::MatrixXd::Zero(size, size)),
        simulation_noise(Eigen::MatrixXd::Zero(size, size)) {}
  Eigen::VectorXd gap;
  Eigen::MatrixXd slope, information, noise, simulation_noise;

  // Of other runs, with the same columns.
  ScoreSystem& operator+=(const ScoreSystem& other);
};

struct RunCounts {
  Eigen::VectorXd data;   // counts per bin, of all flashes
  double scale = 1;       // expected counts of the data for one simulated hit of one fold
  double dispersion = 1;  // variance of counts in units of Poisson's: photons that are seen twice
  double data_dispersion = 1;
  double model_error = 0;
};

// Where a run's own numbers stand; parameters of the ice are the first columns.
struct RunColumns {
  int nuisance = 0;  // brightness (logarithm), and time zero in the column behind it
  // By receiver of the run's bins, its relative efficiency, and by bin its receiver; both empty when
  // efficiencies are as the model has them.
  std::vector<int> efficiency, receiver_of_bin;
};

// Adds a run.
// `seen`: light in the same bins that the weights come from, fold by fold; this light, or the sum of this and
// of earlier simulations of nearly the same ice.
void add_run(const RunLight& light, const RunLight& seen, const RunCounts& counts, const RunColumns& columns,
             ScoreSystem& system);

// Shrinks the weights of combinations of parameters that single ones are not shrunk enough for: a string's
// displacements along x and y both change its light, that across the line to the flasher hardly does, and its
// weights are what noise the two have. Each combination keeps the share of its information that the slopes of
// the other half confirm. `places`: a name for each of the ice's columns; those of one name belong together,
// those without one are left as they are.
void shrink_combinations(const std::vector<std::string>& places, ScoreSystem& system);

// Scales the information of the parameters of a group so that its diagonal adds up to that of the slopes,
// which are too noisy to be asked one by one. `groups`: a name for each of the ice's columns.
void calibrate_information(const std::vector<std::string>& groups, ScoreSystem& system);

}  // namespace floe

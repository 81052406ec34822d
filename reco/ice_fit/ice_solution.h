// Solves the estimating equations of an ice fit, with its priors, within the parameters' limits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/score_system.h"

namespace floe {

struct IcePriors {
  double smoothness = 0.5;  // width of the difference between neighbours of a family
  double amplitude = 1;     // width of a family's members about their start, unless they have their own
};

struct IceSolution {
  Eigen::VectorXd step;              // parameters, then each run's logarithm of brightness and time zero [ns]
  Eigen::MatrixXd covariance;        // of the parameters, nuisances profiled
  std::vector<double> light_errors;  // without priors
};

// Solves gap = information step, with the priors' gap and information added, by Ceres; no parameter moves
// further than `longest` times its scale and none leaves its limits. The noise is in the covariance alone.
IceSolution solve_ice(const ScoreSystem& system, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers, const IcePriors& priors, double longest);

// What the light tells of the first `count` numbers, parameters of the ice, whatever the others are.
Eigen::MatrixXd information_about_ice(const ScoreSystem& system, Eigen::Index count);

}  // namespace floe

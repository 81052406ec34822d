// Log-linear Poisson regression with a Gaussian prior: how one bin's expectation depends on the
// cascade's parameters, learnt from simulations at a few points around.
#pragma once

#include <Eigen/Core>
#include <span>

namespace floe {

// Coefficients: the constant, then one a coordinate (three of place, two of direction).
inline constexpr int regression_coordinates = 5;
inline constexpr int regression_terms = regression_coordinates + 1;
using Coordinates = Eigen::Matrix<double, regression_coordinates, 1>;
using Coefficients = Eigen::Matrix<double, regression_terms, 1>;
using CoefficientMatrix = Eigen::Matrix<double, regression_terms, regression_terms>;

// One simulation's count in the bin: Poisson of mean exp(offset + c_0 + sum_i c_i place_i).
struct RegressionPoint {
  Coordinates place = Coordinates::Zero();
  double offset = 0;
};

struct RegressionPrior {
  Coefficients mean = Coefficients::Zero();
  Coefficients sigma = Coefficients::Ones();  // > 0
};

struct Regression {
  Coefficients coefficients;
  CoefficientMatrix covariance;  // of the posterior, at its maximum
  // Relative variance of the counts about the model, as far as it is significantly (two sigma) beyond
  // Poisson's, >= 0: what a log-linear dependence cannot follow.
  double excess_variance = 0;
};

// Maximum of the posterior (log-concave: Newton with halved steps). points and counts of equal length.
Regression fit_poisson(std::span<const RegressionPoint> points, std::span<const double> counts,
                       const RegressionPrior& prior);

}  // namespace floe

#include "reco/ice_fit/ice_solution.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace floe {

namespace {

constexpr double longest_delay = 20;        // of a round [ns]
constexpr double longest_brightness = 0.7;  // [logarithm]
// Information that is as good as none: the score of a parameter that no light depends on.
constexpr double no_information = 1e-6;

// b - A x
class LinearCost : public ceres::CostFunction {
 public:
  LinearCost(Eigen::MatrixXd A, Eigen::VectorXd b) : A_(std::move(A)), b_(std::move(b)) {
    set_num_residuals(static_cast<int>(A_.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(A_.cols()));
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> at(x[0], A_.cols());
    Eigen::Map<Eigen::VectorXd>(residuals, A_.rows()) = b_ - A_ * at;
    if (jacobians && jacobians[0])
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], A_.rows(), A_.cols()) = -A_;
    return true;
  }

 private:
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
};

// Rows of a prior: each says that a combination of the numbers is 0 within 1.
struct PriorRows {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};
PriorRows prior_rows(const std::vector<IceParameter>& parameters, const std::vector<double>& numbers,
                     const IcePriors& priors, Eigen::Index size) {
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> values;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const IceParameter& p = parameters[i];
    const auto column = static_cast<Eigen::Index>(i);
    const double width = p.family.empty() ? 0 : priors.amplitude;
    if (width > 0) {
      rows.emplace_back(Eigen::VectorXd::Unit(size, column) / width);
      values.push_back((p.start - numbers[i]) / width);
    }
    if (i == 0 || p.family.empty() || parameters[i - 1].family != p.family) continue;
    rows.emplace_back((Eigen::VectorXd::Unit(size, column) - Eigen::VectorXd::Unit(size, column - 1)) /
                      priors.smoothness);
    values.push_back((numbers[i - 1] - numbers[i]) / priors.smoothness);
  }
  PriorRows prior{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), size),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()))};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    prior.A.row(static_cast<Eigen::Index>(i)) = rows[i];
    prior.b(static_cast<Eigen::Index>(i)) = values[i];
  }
  return prior;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& information) {
  return information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

}  // namespace

IceSolution solve_ice(const ScoreSystem& system, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers, const IcePriors& priors, double longest) {
  const Eigen::Index size = system.gap.size();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd noise = system.noise;
  noise.diagonal().array() += no_information;
  const Eigen::LLT<Eigen::MatrixXd> root(noise);
  const Eigen::MatrixXd A = root.matrixL().solve(system.slope);
  const Eigen::VectorXd b = root.matrixL().solve(system.gap);
  const PriorRows prior = prior_rows(parameters, numbers, priors, size);

  std::vector<double> x(static_cast<std::size_t>(size), 0.0);
  ceres::Problem problem;
  problem.AddResidualBlock(new LinearCost(A, b), nullptr, x.data());
  if (prior.b.size() > 0) problem.AddResidualBlock(new LinearCost(prior.A, prior.b), nullptr, x.data());
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double low = 0, high = 0;
    if (i < count) {
      low = std::max(-longest * parameters[k].scale, parameters[k].low - numbers[k]);
      high = std::min(longest * parameters[k].scale, parameters[k].high - numbers[k]);
    } else {
      high = (i - count) % 2 == 0 ? longest_brightness : longest_delay;
      low = -high;
    }
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), std::min(low, 0.0));
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), std::max(high, 0.0));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  IceSolution solution;
  solution.step = Eigen::Map<Eigen::VectorXd>(x.data(), size);
  const Eigen::MatrixXd light = A.transpose() * A;
  solution.covariance = inverse(light + prior.A.transpose() * prior.A).topLeftCorner(count, count);
  Eigen::MatrixXd weak = light;
  weak.diagonal().array() += no_information;
  const Eigen::VectorXd variance = inverse(weak).diagonal();
  for (Eigen::Index i = 0; i < count; ++i)
    solution.light_errors.push_back(variance(i) > 0 && variance(i) < 0.1 / no_information
                                        ? std::sqrt(variance(i))
                                        : std::numeric_limits<double>::infinity());
  return solution;
}

}  // namespace floe

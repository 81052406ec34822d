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
// A direction without any information, shared by as many parameters as there may be, leaves each a variance
// of more than `unknown`.
constexpr double hardly_information = 1e-9, unknown = 1e6;

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
    const double width = p.prior > 0 ? p.prior : p.family.empty() ? 0 : priors.amplitude * p.scale;
    if (width > 0) {
      rows.emplace_back(Eigen::VectorXd::Unit(size, column) / width);
      values.push_back((p.prior_centre.value_or(p.start) - numbers[i]) / width);
    }
    if (i == 0 || p.family.empty() || parameters[i - 1].family != p.family) continue;
    const double difference = priors.smoothness * p.scale;
    rows.emplace_back((Eigen::VectorXd::Unit(size, column) - Eigen::VectorXd::Unit(size, column - 1)) /
                      difference);
    values.push_back((numbers[i - 1] - numbers[i]) / difference);
  }
  PriorRows prior{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), size),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()))};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    prior.A.row(static_cast<Eigen::Index>(i)) = rows[i];
    prior.b(static_cast<Eigen::Index>(i)) = values[i];
  }
  return prior;
}

// b - A x
class LinearCost : public ceres::CostFunction {
 public:
  LinearCost(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) : A_(A), b_(b) {
    set_num_residuals(static_cast<int>(A.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(A.cols()));
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Eigen::VectorXd> at(x[0], A_.cols());
    Eigen::Map<Eigen::VectorXd>(residuals, A_.rows()) = b_ - A_ * at;
    if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], A_.rows(), A_.cols()) = -A_;
    return true;
  }

 private:
  const Eigen::MatrixXd& A_;
  const Eigen::VectorXd& b_;
};

// Minimises |b - A x|^2 over the entries of x that are not held.
Eigen::VectorXd best_of_free(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const std::vector<int>& held,
                             Eigen::VectorXd x) {
  if (held.size() == static_cast<std::size_t>(x.size())) return x;
  ceres::Problem problem;
  problem.AddResidualBlock(new LinearCost(A, b), nullptr, x.data());
  if (!held.empty())
    problem.SetManifold(x.data(), new ceres::SubsetManifold(static_cast<int>(x.size()), held));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  // It is linear: nothing holds the step back but directions without any light.
  options.initial_trust_region_radius = 1e12;
  options.max_trust_region_radius = 1e14;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-13;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return x;
}

// Minimises |b - A x|^2 between limits, low <= 0 <= high, from x = 0 on, by holding what meets its limit and
// letting go of what is drawn back inside (Stark and Parker, Computational Statistics 10, 1995). Ceres' own
// limits will not do: its projected steps end where several parameters at limits are correlated, tens of
// units above the minimum.
Eigen::VectorXd best_within(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& low,
                            const Eigen::VectorXd& high) {
  constexpr double hardly_drawn = 1e-6;  // in the units of one standard deviation
  const Eigen::Index size = A.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  const Eigen::VectorXd widths = A.colwise().norm().transpose().cwiseMax(1e-12);
  std::vector<int> held;
  for (Eigen::Index round = 0; round < 20 * size; ++round) {
    const Eigen::VectorXd best = best_of_free(A, b, held, x);
    // As far as the first limit on the way.
    double share = 1;
    int met = -1;
    for (int i = 0; i < size; ++i) {
      const double limit = best(i) > x(i) ? high(i) : low(i);
      const double way = best(i) - x(i), room = limit - x(i);
      if (std::abs(way) > std::abs(room) && room / way < share) share = room / way, met = i;
    }
    x += share * (best - x);
    if (met >= 0) {
      x(met) = best(met) > x(met) ? high(met) : low(met);
      held.push_back(met);
      continue;
    }
    // What is drawn inside the most is let go.
    const Eigen::VectorXd pull = (A.transpose() * (b - A * x)).cwiseQuotient(widths);
    const auto drawn = [&](int i) { return x(i) == high(i) ? -pull(i) : pull(i); };
    const auto most = std::ranges::max_element(held, {}, drawn);
    if (most == held.end() || drawn(*most) < hardly_drawn) break;
    held.erase(most);
  }
  return x;
}

// The nearest matrix that is no less than nothing in any direction: noise makes information negative where
// there is next to none.
Eigen::MatrixXd without_negative(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(symmetric);
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).asDiagonal() *
         parts.eigenvectors().transpose();
}

// Covariance of x = J^-1 y for a y of covariance C.
Eigen::MatrixXd sandwich(const Eigen::MatrixXd& J, const Eigen::MatrixXd& C) {
  const auto solver = J.ldlt();
  const Eigen::MatrixXd half = solver.solve(C);
  return solver.solve(half.transpose());
}

}  // namespace

IceSolution solve_ice(const ScoreSystem& system, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers, const IcePriors& priors, double longest) {
  const Eigen::Index size = system.gap.size();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const PriorRows prior = prior_rows(parameters, numbers, priors, size);

  Eigen::VectorXd low(size), high(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i < count) {
      low(i) = std::min(0.0, std::max(-longest * parameters[k].scale, parameters[k].low - numbers[k]));
      high(i) = std::max(0.0, std::min(longest * parameters[k].scale, parameters[k].high - numbers[k]));
    } else {
      high(i) = (i - count) % 2 == 0 ? longest_brightness : longest_delay;
      low(i) = -high(i);
    }
  }
  // Scores, and with them the information, differ in size by many orders: brightness is known to a
  // thousandth, time zero in nanoseconds.
  const Eigen::MatrixXd light = without_negative(system.information);
  Eigen::MatrixXd both = light + prior.A.transpose() * prior.A;
  both.diagonal().array() += no_information;
  const Eigen::LLT<Eigen::MatrixXd> root(both);
  const Eigen::VectorXd pull = system.gap + prior.A.transpose() * prior.b;

  IceSolution solution;
  solution.step = best_within(root.matrixU(), root.matrixL().solve(pull), low, high);
  // What neither light nor priors tell of is not known, rather than known without noise.
  Eigen::MatrixXd known = system.noise + prior.A.transpose() * prior.A;
  known.diagonal().array() += no_information;
  solution.covariance = sandwich(both, known).topLeftCorner(count, count);
  Eigen::MatrixXd weak = light;
  Eigen::MatrixXd noise = system.noise;
  for (Eigen::MatrixXd* matrix : {&weak, &noise}) matrix->diagonal().array() += hardly_information;
  const Eigen::VectorXd variance = sandwich(weak, noise).diagonal();
  for (Eigen::Index i = 0; i < count; ++i)
    solution.light_errors.push_back(variance(i) > 0 && variance(i) < unknown
                                        ? std::sqrt(variance(i))
                                        : std::numeric_limits<double>::infinity());
  return solution;
}

Eigen::MatrixXd information_about_ice(const ScoreSystem& system, Eigen::Index count) {
  Eigen::MatrixXd light = without_negative(system.information);
  light.diagonal().array() += hardly_information;
  const Eigen::Index others = light.rows() - count;
  const Eigen::MatrixXd ice = light.topLeftCorner(count, count);
  if (others == 0) return ice;
  const Eigen::MatrixXd shared = light.topRightCorner(count, others);
  return ice - shared * light.bottomRightCorner(others, others).ldlt().solve(shared.transpose());
}

}  // namespace floe

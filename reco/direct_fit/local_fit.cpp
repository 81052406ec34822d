#include "reco/direct_fit/local_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "reco/likelihood/limited_simulation.h"

namespace floe {
namespace {

class BinCost : public ceres::CostFunction {
 public:
  explicit BinCost(const Emulator& emulator) : emulator_(emulator) {
    set_num_residuals(static_cast<int>(emulator.bins().size()));
    mutable_parameter_block_sizes()->push_back(7);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    std::vector<Emulator::Evaluation> values;
    emulator_.evaluate(Eigen::Map<const Vector7>(parameters[0]), values);
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = emulator_.bins()[i];
      const BinLikelihood likelihood = emulator_.likelihood(bin, values[i].log_mean);
      if (!std::isfinite(likelihood.value)) return false;
      const double size = std::sqrt(2 * likelihood.value);
      residuals[i] = std::copysign(size, likelihood.slope);
      // d residual / d ln mu; near a perfect match both slope and residual vanish.
      const double gain = size == 0 && likelihood.curvature == 0          ? 0  // left out
                          : size > 1e-6 * std::sqrt(likelihood.curvature) ? likelihood.slope / residuals[i]
                                                                          : std::sqrt(likelihood.curvature);
      if (jacobian) Eigen::Map<Vector7>(jacobian + 7 * i) = gain * values[i].gradient;
    }
    return true;
  }

 private:
  const Emulator& emulator_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> make_cost(const Emulator& emulator) {
  return std::make_unique<BinCost>(emulator);
}

Vector7 trust_region(const EmulatorSettings& settings) {
  Vector7 size;
  size << Vec3::Constant(1.5 * settings.position_step),
      Eigen::Vector2d::Constant(1.5 * settings.direction_step),
      20 + 2 * light_slowness() * settings.position_step, 1.5;
  return size;
}

Matrix7 covariance_of(const Matrix7& information) {
  // Metres, radians and nanoseconds differ by orders of magnitude: judge the correlation matrix.
  const Vector7 scale = information.diagonal().cwiseMax(0).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix7> solver(scale.asDiagonal() * information * scale.asDiagonal());
  if (!scale.allFinite() || solver.info() != Eigen::Success || solver.eigenvalues().minCoeff() < 1e-8)
    return Matrix7::Constant(std::numeric_limits<double>::infinity());
  const Matrix7 inverse = solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
                          solver.eigenvectors().transpose();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

LocalFit fit_locally(const Emulator& emulator) {
  LocalFit fit;
  const Vector7 size = trust_region(emulator.settings());
  ceres::Problem problem;
  problem.AddResidualBlock(make_cost(emulator).release(), nullptr, fit.step.data());
  for (int i = 0; i < 7; ++i) {
    problem.SetParameterLowerBound(fit.step.data(), i, -size(i));
    problem.SetParameterUpperBound(fit.step.data(), i, size(i));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = 60;
  options.function_tolerance = 1e-7;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  fit.converged = summary.termination_type == ceres::CONVERGENCE;
  fit.neg_llh = summary.final_cost;
  fit.information = emulator.information(fit.step);
  return fit;
}

}  // namespace floe

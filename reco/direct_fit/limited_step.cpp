#include "reco/direct_fit/limited_step.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace floe {

Vector7 limited_step(const Vector7& step, const Matrix7& slope, const Matrix7& information,
                     const Vector7& most) {
  const double length = step.cwiseAbs().cwiseQuotient(most).maxCoeff();
  if (length <= 1) return step;
  const Eigen::LLT<Matrix7> weight(information);
  if (weight.info() != Eigen::Success) return step / length;
  // Least squares in units of the region, in which the penalty of leaving is the same for all seven.
  const Matrix7 equations = slope * most.asDiagonal();
  const Matrix7 normal = equations.transpose() * weight.solve(equations);
  const Vector7 right = equations.transpose() * weight.solve(slope * step);
  const auto damped = [&](double damping) {
    return Vector7((normal + damping * Matrix7::Identity()).ldlt().solve(right));
  };
  double low = std::log(1e-12 * normal.trace()), high = std::log(right.norm());  // there the step is below 1
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (damped(std::exp(middle)).cwiseAbs().maxCoeff() > 1 ? low : high) = middle;
  }
  return most.asDiagonal() * damped(std::exp(high));
}

}  // namespace floe

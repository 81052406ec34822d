#include "reco/crystal/diffusion_fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "data/base/error.h"
#include "propagation/ice/diffusion_functions.h"

namespace floe {

namespace {

constexpr double least_D = 0.01, most_D = 100;  // below it, atan(D s) is D s within 3e-5
constexpr int D_place = 3;

using Coordinates = Eigen::Vector4d;
template <typename Scalar>
using Numbers = std::array<Scalar, 4>;  // A, B, C, D

// The coordinates that fits move in, and their bounds: as A, B, C, D, the functions are nearly degenerate.
// Width: ln of the value along the flow, ln of its fall to the value across, C, ln D.
struct Width {
  inline static const Numbers<double> start{-2.5, 0, 2, 0}, low{-20, -10, 0.5, std::log(least_D)},
      high{2, 5, 6, std::log(most_D)};
  template <typename Scalar>
  static Numbers<Scalar> numbers(const Scalar* q) {
    using std::atan, std::exp, std::pow;
    const Scalar D = exp(q[3]);
    return {exp(q[0]), exp(q[1]) / pow(atan(D), q[2]), q[2], D};
  }
  template <typename Scalar>
  static Scalar value(const Numbers<Scalar>& n, double angle) {
    // 0^C has no derivative by C.
    return sigma_function(n[0], n[1], n[2], n[3], std::max(std::sin(angle), 1e-6));
  }
};

// Deflection: value at 45 deg in units of 0.001, B, C, ln D.
struct Deflection {
  inline static const Numbers<double> start{1, 0, 1, 0}, low{-1e3, -6, -6, std::log(least_D)},
      high{1e3, 6, 6, std::log(most_D)};
  template <typename Scalar>
  static Numbers<Scalar> numbers(const Scalar* q) {
    using std::exp;
    const double half = std::sqrt(0.5);
    const Scalar D = exp(q[3]), one(1);
    return {1e-3 * q[0] / mean_function(one, q[1], q[2], D, half, half), q[1], q[2], D};
  }
  template <typename Scalar>
  static Scalar value(const Numbers<Scalar>& n, double angle) {
    return mean_function(n[0], n[1], n[2], n[3], std::sin(angle), std::cos(angle));
  }
};

template <typename Function>
struct Residual {
  AngleValue point;
  template <typename Scalar>
  bool operator()(const Scalar* q, Scalar* residual) const {
    residual[0] = (Function::value(Function::numbers(q), point.angle) - point.value) / point.error;
    return ceres::isfinite(residual[0]);
  }
};

struct Solution {
  Coordinates place;
  double cost;
  bool D_held;
};

template <typename Function>
void build(ceres::Problem& problem, std::span<const AngleValue> points, Coordinates& place) {
  using Cost = ceres::AutoDiffCostFunction<Residual<Function>, 1, 4>;
  for (const AngleValue& point : points)
    problem.AddResidualBlock(new Cost(new Residual<Function>{point}), nullptr, place.data());
  for (int i = 0; i < 4; ++i) {
    problem.SetParameterLowerBound(place.data(), i, Function::low[static_cast<std::size_t>(i)]);
    problem.SetParameterUpperBound(place.data(), i, Function::high[static_cast<std::size_t>(i)]);
  }
}

template <typename Function>
std::optional<Solution> solve(std::span<const AngleValue> points, double D, bool hold) {
  Coordinates place = Coordinates::Map(Function::start.data());
  place[D_place] = std::log(D);
  ceres::Problem problem;
  build<Function>(problem, points, place);
  if (hold) problem.SetManifold(place.data(), new ceres::SubsetManifold(4, {D_place}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-12;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  return Solution{place, summary.final_cost, hold};
}

// From several D, since small and large ones are different valleys; with D held where it would go further.
template <typename Function>
Solution best_solution(std::span<const AngleValue> points) {
  std::optional<Solution> best;
  for (const double D : {0.1, 1.0, 5.0, 30.0})
    if (const auto found = solve<Function>(points, D, false); found && (!best || found->cost < best->cost))
      best = found;
  for (const double D : {least_D, most_D})
    if (const auto held = solve<Function>(points, D, true);
        held && (!best || held->cost <= best->cost * (1 + 1e-6) + 1e-9))
      best = held;
  if (!best) throw NoResult("diffusion patterns: the function does not fit to the angles' values");
  return *best;
}

// Of the numbers, from the covariance of the coordinates.
template <typename Function>
Eigen::Vector4d errors_of(std::span<const AngleValue> points, const Solution& solution) {
  const int free = solution.D_held ? 3 : 4;
  using Jet = ceres::Jet<double, 4>;
  std::array<Jet, 4> q;
  for (int i = 0; i < 4; ++i) q[i] = Jet(solution.place[i], i);
  const Numbers<Jet> numbers = Function::numbers(q.data());
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero(), slopes;
  for (const AngleValue& point : points) {
    const Eigen::Vector4d slope = Function::value(numbers, point.angle).v / point.error;
    information += slope * slope.transpose();
  }
  for (int i = 0; i < 4; ++i) slopes.row(i) = numbers[i].v.transpose();
  const Eigen::MatrixXd part = slopes.leftCols(free);
  const Eigen::MatrixXd covariance =
      part * information.topLeftCorner(free, free).ldlt().solve(part.transpose().eval());
  return covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

DiffusionFunction function_of(const double* n) {
  return {n[0], n[1], n[2], n[3]};
}

template <typename Function>
FunctionFit fit(std::span<const AngleValue> all) {
  std::vector<AngleValue> points(all.begin(), all.end());
  std::erase_if(points, [](const AngleValue& point) { return !(point.error > 0); });
  if (points.size() < 5)
    throw NoResult(
        fmt::format("diffusion patterns: {} angles have a value with an error; the fit of 4 numbers "
                    "needs 5 or more",
                    points.size()));
  const Solution solution = best_solution<Function>(points);
  const Numbers<double> numbers = Function::numbers(solution.place.data());
  const Eigen::Vector4d errors = errors_of<Function>(points, solution);
  FunctionFit result{function_of(numbers.data()), function_of(errors.data()), solution.D_held};
  double largest = 0;
  for (const AngleValue& point : points) {
    const double off = Function::value(numbers, point.angle) - point.value;
    result.chi_square += std::pow(off / point.error, 2);
    result.worst = std::max(result.worst, std::abs(off));
    largest = std::max(largest, std::abs(point.value));
  }
  if (largest > 0) result.worst /= largest;
  result.degrees_of_freedom = static_cast<int>(points.size()) - (solution.D_held ? 3 : 4);
  return result;
}

}  // namespace

FunctionFit fit_sigma(std::span<const AngleValue> points) {
  return fit<Width>(points);
}

FunctionFit fit_mean(std::span<const AngleValue> points) {
  return fit<Deflection>(points);
}

BirefringenceNumbers DiffusionFit::numbers() const {
  BirefringenceNumbers all;
  all.sigma_x = functions[0].numbers;
  all.sigma_y = functions[1].numbers;
  all.mean_x = functions[2].numbers;
  return all;
}

DiffusionFit fit_diffusion(std::span<const CrystalPattern> patterns, double grain,
                           PatternEstimator estimator) {
  using enum PatternNumber;
  const bool core = estimator == PatternEstimator::core;
  const std::array sources{core ? core_sigma_x : sigma_x, core ? core_sigma_y : sigma_y,
                           core ? core_mean_x : mean_x};
  DiffusionFit result;
  for (const CrystalPattern& pattern : patterns) {
    const double ratio = 1000 * grain / pattern.length;
    for (std::size_t i = 0; i < 3; ++i) {
      const double scale = i < 2 ? std::sqrt(ratio) : ratio;
      const Estimate estimate = pattern.statistics[sources[i]];
      result.points[i].push_back({pattern.angle, scale * estimate.value, scale * estimate.error});
    }
  }
  result.functions = {fit_sigma(result.points[0]), fit_sigma(result.points[1]), fit_mean(result.points[2])};
  return result;
}

}  // namespace floe

#include "reco/paper_figures/azimuth_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "data/base/vec3.h"

namespace floe {

namespace {

constexpr int most_rounds = 50;
constexpr double small_step = 1e-12;

Eigen::Vector2d wave(double azimuth) {
  return {std::cos(2 * azimuth), std::sin(2 * azimuth)};
}

// Parameters: the modulation, then a level for each group.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd vector;
  double chi2 = 0;
};

Normal normal_equations(std::span<const AzimuthPoint> points, const Eigen::VectorXd& parameters) {
  const Eigen::Index n = parameters.size();
  Normal normal{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (const AzimuthPoint& point : points) {
    const auto level = static_cast<Eigen::Index>(2 + point.group);
    const double curve = 1 + parameters.head<2>().dot(wave(point.azimuth));
    const double fitted = parameters(level) * curve;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
    slope.head<2>() = parameters(level) * wave(point.azimuth);
    slope(level) = curve;
    const double error = fitted * point.relative_error, off = point.ratio - fitted;
    normal.matrix += slope * slope.transpose() / (error * error);
    normal.vector += slope * off / (error * error);
    normal.chi2 += off * off / (error * error);
  }
  return normal;
}

Eigen::VectorXd first_guess(std::span<const AzimuthPoint> points) {
  std::size_t groups = 0;
  for (const AzimuthPoint& point : points) groups = std::max(groups, point.group + 1);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(2 + groups), counts = sums;
  for (const AzimuthPoint& point : points) {
    sums(2 + point.group) += point.ratio;
    counts(2 + point.group) += 1;
  }
  for (Eigen::Index i = 2; i < sums.size(); ++i) {
    if (counts(i) == 0) throw NoResult("light against azimuth: a flasher has no points to fit");
    sums(i) /= counts(i);
  }
  return sums;
}

}  // namespace

AzimuthFit fit_azimuth(std::span<const AzimuthPoint> points) {
  Eigen::VectorXd parameters = first_guess(points);
  const auto unknowns = static_cast<int>(parameters.size());
  const NoResult vague("light against azimuth: the points do not tell amplitude and direction");
  if (static_cast<int>(points.size()) < unknowns) throw vague;
  Eigen::MatrixXd covariance;
  double step = 1;
  for (int round = 0; round < most_rounds && step > small_step; ++round) {
    const Normal normal = normal_equations(points, parameters);
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal.matrix);
    if (!normal.matrix.allFinite() || !(solver.rcond() > 1e-12)) throw vague;
    covariance = solver.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
    const Eigen::VectorXd change = solver.solve(normal.vector);
    parameters += change;
    step = change.cwiseAbs().maxCoeff();
  }
  if (!(parameters.head<2>().norm() < 1)) throw vague;
  AzimuthFit fit;
  fit.modulation = parameters.head<2>();
  fit.covariance = covariance.topLeftCorner<2, 2>();
  fit.levels.assign(parameters.begin() + 2, parameters.end());
  fit.chi2 = normal_equations(points, parameters).chi2;
  fit.ndof = static_cast<int>(points.size()) - unknowns;
  return fit;
}

double AzimuthFit::value(double azimuth) const {
  return 1 + modulation.dot(wave(azimuth));
}

double AzimuthFit::amplitude_error() const {
  return along_error(phase());
}

double AzimuthFit::phase() const {
  const double phi = std::atan2(modulation.y(), modulation.x()) / 2;
  return phi < 0 ? phi + pi : phi;
}

double AzimuthFit::phase_error() const {
  return along_error(phase() + pi / 4) / (2 * amplitude());
}

double AzimuthFit::max_over_min_error() const {
  const double c = amplitude();
  return 2 * amplitude_error() / ((1 - c) * (1 - c));
}

double AzimuthFit::along(double axis) const {
  return modulation.dot(wave(axis));
}

double AzimuthFit::along_error(double axis) const {
  return std::sqrt(wave(axis).dot(covariance * wave(axis)));
}

double AzimuthFit::isotropy_p_value() const {
  return std::exp(-0.5 * modulation.dot(covariance.inverse() * modulation));
}

}  // namespace floe

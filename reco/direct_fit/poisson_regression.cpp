#include "reco/direct_fit/poisson_regression.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace floe {
namespace {

Coefficients terms_of(const RegressionPoint& point) {
  Coefficients x;
  x << 1, point.place;
  return x;
}

// Minus the logarithm of the posterior, without constants.
double cost(std::span<const RegressionPoint> points, std::span<const double> counts,
            const RegressionPrior& prior, const Coefficients& c) {
  double sum = 0.5 * (c - prior.mean).cwiseQuotient(prior.sigma).squaredNorm();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double log_mean = points[i].offset + c.dot(terms_of(points[i]));
    sum += std::exp(std::min(log_mean, 100.0)) - counts[i] * log_mean;
  }
  return sum;
}

// How much more the counts vary than the model and Poisson allow, relative to the mean squared.
double excess_variance(std::span<const RegressionPoint> points, std::span<const double> counts,
                       const Regression& fit) {
  double above = 0, noise = 0, square = 0, spent = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Coefficients x = terms_of(points[i]);
    const double mean = std::exp(points[i].offset + fit.coefficients.dot(x));
    // Residuals are smaller than the noise by the leverage of their own count.
    const double leverage = std::min(0.95, mean * x.dot(fit.covariance * x));
    above += (counts[i] - mean) * (counts[i] - mean) / (1 - leverage) - mean;
    noise += mean + 2 * mean * mean;  // the variance of a squared Poisson residual
    square += mean * mean;
    spent += leverage;
  }
  if (square <= 0 || double(points.size()) - spent < 2) return 0;
  return std::max(0.0, (above - 2 * std::sqrt(noise)) / square);
}

}  // namespace

Regression fit_poisson(std::span<const RegressionPoint> points, std::span<const double> counts,
                       const RegressionPrior& prior) {
  assert(points.size() == counts.size());
  Regression fit;
  fit.coefficients = prior.mean;
  double now = cost(points, counts, prior, fit.coefficients);
  const Coefficients weight = prior.sigma.cwiseAbs2().cwiseInverse();
  for (int iteration = 0; iteration < 60; ++iteration) {
    Coefficients gradient = weight.cwiseProduct(fit.coefficients - prior.mean);
    CoefficientMatrix hessian = weight.asDiagonal();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Coefficients x = terms_of(points[i]);
      const double mean = std::exp(std::min(points[i].offset + fit.coefficients.dot(x), 100.0));
      gradient += (mean - counts[i]) * x;
      hessian += mean * x * x.transpose();
    }
    const Eigen::LLT<CoefficientMatrix> factor(hessian);
    fit.covariance = factor.solve(CoefficientMatrix::Identity());
    Coefficients step = -factor.solve(gradient);
    const double promise = -gradient.dot(step);
    if (promise < 1e-9) break;
    // The exponential punishes steps that are too long: never more than a few e-foldings at once.
    const double longest = std::abs(step(0));
    if (longest > 3) step *= 3 / longest;
    double next = cost(points, counts, prior, fit.coefficients + step);
    for (int i = 0; i < 30 && !(next <= now); ++i) {
      step *= 0.5;
      next = cost(points, counts, prior, fit.coefficients + step);
    }
    if (!(next <= now)) break;
    fit.coefficients += step;
    now = next;
  }
  fit.excess_variance = excess_variance(points, counts, fit);
  return fit;
}

}  // namespace floe

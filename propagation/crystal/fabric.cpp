#include "propagation/crystal/fabric.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "data/base/error.h"

namespace floe {

namespace {

// ln of the integral of exp(-sum rate_i c_i^2), and the moments <c_i^2>, <c_i^2 c_j^2> under it.
struct Moments {
  double log_integral = 0;
  Eigen::Vector3d second = Eigen::Vector3d::Zero();
  Eigen::Matrix3d fourth = Eigen::Matrix3d::Zero();
};

// Midpoints over an octant, in the azimuth around the first axis and in s with c_1 = s^3, which puts points
// where a large rate of that axis leaves something to integrate.
Moments moments_of(const std::array<double, 3>& rates) {
  constexpr int rings = 2000, places = 128;
  Moments m;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double s = (i + 0.5) / rings, c1 = s * s * s, across = 1 - c1 * c1;
    for (int k = 0; k < places; ++k) {
      const double cosine = std::cos(pi / 2 * (k + 0.5) / places), square = cosine * cosine;
      const Eigen::Vector3d squares(c1 * c1, across * (1 - square), across * square);
      const double weight =
          3 * s * s * std::exp(-rates[0] * squares[0] - rates[1] * squares[1] - rates[2] * squares[2]);
      sum += weight;
      m.second += weight * squares;
      m.fourth += weight * squares * squares.transpose();
    }
  }
  m.second /= sum;
  m.fourth /= sum;
  m.log_integral = std::log(sum);
  return m;
}

// The rates of x (S3) and y (S2), that of z (S1) being 0, at which the moments are the eigenvalues: where the
// likelihood, which is concave, has its maximum. Newton's steps, halved until they gain.
BinghamRates fit_rates(const FabricEigenvalues& wanted) {
  const Eigen::Vector2d moments(wanted.S3, wanted.S2);
  const auto rates_at = [](const Eigen::Vector2d& r) { return std::array{r[0], r[1], 0.0}; };
  const auto log_likelihood = [&](const Eigen::Vector2d& r, const Moments& m) {
    return -r.dot(moments) - m.log_integral;
  };
  Eigen::Vector2d rates(0.5 / wanted.S3 - 0.5 / wanted.S1, 0.5 / wanted.S2 - 0.5 / wanted.S1);
  Moments here = moments_of(rates_at(rates));
  for (int round = 0; round < 50; ++round) {
    const Eigen::Vector2d mean = here.second.head<2>(), gradient = mean - moments;
    if (gradient.cwiseQuotient(moments).cwiseAbs().maxCoeff() < 1e-9) return {rates_at(rates.cwiseMax(0))};
    const Eigen::Matrix2d covariance = here.fourth.topLeftCorner<2, 2>() - mean * mean.transpose();
    Eigen::Vector2d step = covariance.ldlt().solve(gradient);
    for (int halving = 0; halving < 30; ++halving, step /= 2) {
      const Moments there = moments_of(rates_at(rates + step));
      if (log_likelihood(rates + step, there) >= log_likelihood(rates, here) - 1e-13) {
        rates += step;
        here = there;
        break;
      }
    }
  }
  throw NoResult(fmt::format("no Bingham distribution found with the eigenvalues {:g}, {:g}, {:g}", wanted.S1,
                             wanted.S2, wanted.S3));
}

}  // namespace

FabricEigenvalues fabric_eigenvalues(double ln_S1_S2, double ln_S2_S3) {
  for (const double ratio : {ln_S1_S2, ln_S2_S3})
    if (!(ratio >= 0 && ratio <= largest_log_ratio))
      throw UsageError(fmt::format("ratio of a fabric's eigenvalues: found ln {:g}; expected 0 to {:g}",
                                   ratio, largest_log_ratio));
  const double S3 = 1, S2 = std::exp(ln_S2_S3), S1 = S2 * std::exp(ln_S1_S2), sum = S1 + S2 + S3;
  return {S1 / sum, S2 / sum, S3 / sum};
}

std::array<double, 3> second_moments(const BinghamRates& rates) {
  const Moments m = moments_of(rates.rates);
  return {m.second[0], m.second[1], m.second[2]};
}

Fabric Fabric::isotropic() {
  return {};
}

Fabric Fabric::girdle() {
  Fabric fabric;
  fabric.scale_ = {0, 1, 1};
  return fabric;
}

Fabric Fabric::bingham(const BinghamRates& bingham) {
  const auto& rates = bingham.rates;
  if (*std::max_element(rates.begin(), rates.end()) == 0) return isotropic();
  // b with sum 1/(b + 2 rate_i) = 1, which lies between 1 and 3, makes the thinning lightest.
  double low = 1, high = 3;
  for (int round = 0; round < 60; ++round) {
    const double b = (low + high) / 2;
    double sum = 0;
    for (const double rate : rates) sum += 1 / (b + 2 * rate);
    (sum > 1 ? low : high) = b;
  }
  const double b = (low + high) / 2;
  Fabric fabric;
  fabric.rates_ = rates;
  for (int i = 0; i < 3; ++i) fabric.scale_[i] = 1 / std::sqrt(1 + 2 * rates[i] / b);
  fabric.keep_ = std::exp((3 - b) / 2) * std::pow(b / 3, 1.5);
  fabric.keeps_all_ = false;
  return fabric;
}

Fabric Fabric::from_eigenvalues(const FabricEigenvalues& eigenvalues) {
  return bingham(fit_rates(eigenvalues));
}

Vec3 Fabric::draw(RandomStream& stream) const {
  while (true) {
    const double along = 2 * fine_uniform(stream) - 1;
    const Trial found = trial(scale_, rates_, keep_, along, turn_functions(fine_uniform(stream)));
    if (keeps_all_ || fine_uniform(stream) < found.weight * decay(-found.exponent))
      return {found.x, found.y, found.z};
  }
}

}  // namespace floe

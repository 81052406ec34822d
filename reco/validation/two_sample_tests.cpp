#include "reco/validation/two_sample_tests.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

namespace floe {

double chi_square_probability(double chi_square, double degrees) {
  return Eigen::numext::igammac(degrees / 2, chi_square / 2);
}

double ln_chi_square_probability(double chi_square, double degrees) {
  constexpr double smallest = 1e-280;
  const double x = chi_square / 2, a = degrees / 2;
  const double probability = Eigen::numext::igammac(a, x);
  if (probability > smallest) return std::log(probability);
  // x is hundreds here: the first two terms of the asymptotic series (Abramowitz and Stegun 6.5.32).
  return (a - 1) * std::log(x) - x - std::lgamma(a) + std::log1p((a - 1) / x);
}

namespace {
// Kolmogorov's distribution: 2 sum_k (-1)^(k-1) exp(-2 k^2 x^2).
double kolmogorov_probability(double x) {
  if (x < 0.2) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}
}  // namespace

KolmogorovSmirnov kolmogorov_smirnov(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  double distance = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= value) ++i;
    while (j < b.size() && b[j] <= value) ++j;
    distance = std::max(distance, std::abs(static_cast<double>(i) / na - static_cast<double>(j) / nb));
  }
  const double root = std::sqrt(na * nb / (na + nb));
  return {distance, kolmogorov_probability((root + 0.12 + 0.11 / root) * distance)};
}

}  // namespace floe

#include "reco/likelihood/limited_simulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floe {
namespace {

// count ln(count/(count + w)) + w, the Poisson term of a count whose expectation is count + w >= 0;
// accurate for small w.
double poisson_term(double count, double w) {
  if (count <= 0) return std::max(w, 0.0);
  const double x = w / count;
  if (std::abs(x) < 1e-4) return count * x * x * (0.5 - x * (1.0 / 3 - 0.25 * x));
  return w - count * std::log1p(x);
}

// Root of g(w) = sigma^2 w - ln((d - w)/n_d) + ln((s + w)/n_s), which rises from -infinity at -s to
// infinity at d. Newton in w, halving the bracket wherever a step would leave it.
double shared_excess(const BinCounts& c, double sigma) {
  const double d = c.data, s = c.simulation;
  const double pooled = (d + s) / (c.data_events + c.simulation_events);
  double w = d - c.data_events * pooled;  // the root at sigma = 0
  if (sigma == 0 || w == 0) return w;

  // sigma > 0 lets the rates differ: the root lies between 0 and the one at sigma = 0.
  double low = std::min(w, 0.0), high = std::max(w, 0.0);
  w *= 1 / (1 + sigma * sigma / (1 / (d - w) + 1 / (s + w)));
  const double log_events = std::log(c.data_events / c.simulation_events);
  for (int i = 0; i < 200; ++i) {
    const double g = sigma * sigma * w + std::log((s + w) / (d - w)) + log_events;
    (g > 0 ? high : low) = w;
    const double step = g / (sigma * sigma + 1 / (d - w) + 1 / (s + w));
    double next = w - step;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool done = std::abs(next - w) <= 1e-12 * std::abs(next);
    w = next;
    if (done) break;
  }
  return w;
}

// Continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by Lentz' method;
// converges fast for x < (a + 1)/(a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto safe = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1, d = 1 / safe(1 - (a + b) * x / (a + 1)), result = d;
  for (int m = 1; m < 100000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / safe(1 + even * d), c = safe(1 + even / c);
    result *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / safe(1 + odd * d), c = safe(1 + odd / c);
    result *= d * c;
    if (std::abs(d * c - 1) < 1e-13) break;
  }
  return result;
}

}  // namespace

BinLikelihood at_least(const BinCounts& c, double sigma) {
  assert(c.data > 0 && c.simulation > 0 && c.data_events > 0 && c.simulation_events > 0 && sigma >= 0);
  const double mu = c.data_events * c.simulation / c.simulation_events;
  const double a = c.data, b = 1 / std::max(sigma * sigma + 1 / c.simulation, 1e-7);
  const double x = mu / (mu + b), y = b / (mu + b);
  const double log_density =  // of x^a y^b / B(a, b)
      a * std::log(x) + b * std::log(y) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  double log_probability;
  if (x < (a + 1) / (a + b + 2))
    log_probability = log_density + std::log(beta_fraction(a, b, x) / a);
  else
    log_probability = std::log1p(-std::min(std::exp(log_density) * beta_fraction(b, a, y) / b, 1.0));
  BinLikelihood result;
  result.data_rate = result.simulation_rate = c.simulation / c.simulation_events;
  result.value = std::max(0.0, -log_probability);
  const double hazard = std::exp(log_density - log_probability);  // d ln P / d ln mu
  result.slope = -hazard;
  result.curvature = std::max(0.0, hazard * (hazard - a * y + b * x));
  return result;
}

BinLikelihood limited_simulation(const BinCounts& c, double sigma) {
  assert(c.data >= 0 && c.simulation >= 0 && c.data_events > 0 && c.simulation_events > 0 && sigma >= 0);
  if (c.data == 0 && c.simulation == 0) return {};
  const double w = shared_excess(c, sigma);
  BinLikelihood result;
  result.data_rate = (c.data - w) / c.data_events;
  result.simulation_rate = (c.simulation + w) / c.simulation_events;
  result.value = poisson_term(c.data, -w) + poisson_term(c.simulation, w) + 0.5 * sigma * sigma * w * w;
  result.slope = -w;
  const double free_data = c.data - w, free_simulation = c.simulation + w;
  if (free_data > 0 && free_simulation > 0)
    result.curvature = 1 / (sigma * sigma + 1 / free_data + 1 / free_simulation);
  return result;
}

double expected_curvature(double counts, double effective_simulation, double sigma) {
  if (counts <= 0 || effective_simulation <= 0) return 0;
  return 1 / (sigma * sigma + 1 / counts + 1 / effective_simulation);
}

}  // namespace floe

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

}  // namespace

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

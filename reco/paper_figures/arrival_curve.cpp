#include "reco/paper_figures/arrival_curve.h"

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "propagation/ice/ice_model.h"

namespace floe {

namespace {

constexpr double wavelength = 405;               // of flashers [nm]
constexpr double narrowest = 20, growth = 0.12;  // [ns]; share of the time since the first light
constexpr double last_time = 2500;               // after the first light [ns]

// The charge's quantile of a sorted list of times.
double quantile(const std::vector<double>& times, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(times.size() - 1);
  return times[static_cast<std::size_t>(std::lround(place))];
}

}  // namespace

std::vector<double> arrival_edges(double distance) {
  // Wide modules reach a little nearer to the flasher: a bin more.
  const double direct = distance * group_index(wavelength) / speed_of_light;
  const double first = (std::floor(direct / narrowest) - 1) * narrowest;
  std::vector<double> edges{first};
  while (edges.back() < first + last_time)
    edges.push_back(edges.back() + std::max(narrowest, growth * (edges.back() - first)));
  return edges;
}

ArrivalCurve arrival_curve(std::span<const SimulatedHit> hits, std::span<const std::uint32_t> modules,
                           std::span<const double> edges) {
  ArrivalCurve curve;
  curve.charge.assign(edges.size() - 1, 0.0);
  curve.variance = curve.charge;
  std::vector<double> times;
  for (const SimulatedHit& hit : hits) {
    if (std::find(modules.begin(), modules.end(), hit.module) == modules.end()) continue;
    const double weight = hit.weight;
    curve.total += weight;
    curve.total_variance += weight * weight;
    times.push_back(hit.time);
    const auto above = std::upper_bound(edges.begin(), edges.end(), hit.time);
    if (above == edges.begin() || above == edges.end()) continue;
    const auto bin = static_cast<std::size_t>(above - edges.begin()) - 1;
    curve.charge[bin] += weight;
    curve.variance[bin] += weight * weight;
  }
  if (times.empty()) return curve;
  std::sort(times.begin(), times.end());
  const double spread = 0.5 / std::sqrt(static_cast<double>(times.size()));
  curve.median = quantile(times, 0.5);
  curve.median_error = (quantile(times, 0.5 + spread) - quantile(times, 0.5 - spread)) / 2;
  return curve;
}

}  // namespace floe

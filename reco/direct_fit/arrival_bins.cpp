#include "reco/direct_fit/arrival_bins.h"

#include <algorithm>
#include <cmath>

#include "reco/direct_fit/common_shape.h"
#include "reco/direct_fit/point_light.h"

namespace floe {
namespace {

constexpr double least_width = 4;        // of a bin [ns]
constexpr std::size_t enough_hits = 80;  // for a module's own quantiles
constexpr double shell_width = 25;       // of modules that share quantiles [m]
constexpr std::size_t shells = 40, angles = 3;

std::size_t bins_for(double expected) {
  return expected < 1 ? 4 : expected < 10 ? 6 : expected < 50 ? 8 : expected < 300 ? 12 : 16;
}

std::vector<double> quantile_edges(const std::vector<float>& sorted, std::size_t bins) {
  std::vector<double> edges;
  for (std::size_t k = 1; k < bins; ++k) {
    const double share = std::pow(double(k) / double(bins), 1.5);
    const auto place = static_cast<std::size_t>(share * double(sorted.size()));
    const double edge = double(sorted[std::min(place, sorted.size() - 1)]);
    if (edges.empty() || edge > edges.back() + least_width) edges.push_back(edge);
  }
  return edges;
}

struct ModuleTimes {
  std::vector<float> after;  // arrival times after the direct light [ns]
  double direct = 0;         // arrival of the direct light from the frame's origin [ns]
  std::size_t group = 0;
};

}  // namespace

std::vector<std::vector<double>> arrival_edges(const EventData& data, const LocalFrame& frame,
                                               std::span<const LightSample* const> samples, CascadeKind kind,
                                               double least_expected) {
  const LightCentre& origin = frame.origin();
  std::vector<ModuleTimes> modules;
  std::vector<std::vector<float>> groups(shells * angles);
  double repeats = 0;
  for (const LightSample* sample : samples) repeats += sample->repeats;
  for (const ModuleData& lit : data.lit()) {
    ModuleTimes module;
    const Vec3& place = data.detector().modules()[lit.module].position;
    const Sight seen = sight(origin.position, origin.direction, place);
    module.direct = origin.time + light_slowness() * seen.distance;
    const auto shell = std::min(shells - 1, static_cast<std::size_t>(seen.distance / shell_width));
    module.group = shell * angles + (seen.cosine < -0.3 ? 0 : seen.cosine < 0.3 ? 1 : 2);
    for (const LightSample* sample : samples) {
      const LightCentre light = light_centre(sample->cascade, kind);
      const double delay =
          light.time - sample->cascade.time + light_slowness() * soft_distance(place - light.position);
      for (const float* time = sample->begin(lit.module); time != sample->end(lit.module); ++time)
        module.after.push_back(static_cast<float>(*time - delay));
    }
    std::sort(module.after.begin(), module.after.end());
    auto& group = groups[module.group];
    group.insert(group.end(), module.after.begin(), module.after.end());
    modules.push_back(std::move(module));
  }
  for (auto& group : groups) std::sort(group.begin(), group.end());

  std::vector<std::vector<double>> result;
  for (const ModuleTimes& module : modules) {
    const double expected = double(module.after.size()) * data.repeats() / repeats;
    const auto& times = module.after.size() >= enough_hits ? module.after : groups[module.group];
    std::vector<double> edges;
    if (times.size() >= enough_hits / 4 && expected >= least_expected)
      edges = quantile_edges(times, bins_for(expected));
    for (double& edge : edges) edge += module.direct;
    result.push_back(std::move(edges));
  }
  return result;
}

}  // namespace floe

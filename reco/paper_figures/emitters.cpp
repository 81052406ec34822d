#include "reco/paper_figures/emitters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/sources/flasher.h"

namespace floe {

namespace {

constexpr std::size_t ring_size = 6;
constexpr double widest_gap = 90 * degree;
constexpr double oversize = 16;  // as in fits of the ice

double depth_of(const Module& module) {
  return origin_depth - module.position.z();
}

double azimuth_of(const Eigen::Vector2d& way) {
  const double azimuth = std::atan2(way.y(), way.x());
  return azimuth < 0 ? azimuth + 2 * pi : azimuth;
}

bool all_around(const std::vector<Neighbour>& by_azimuth) {
  double widest = by_azimuth.front().azimuth + 2 * pi - by_azimuth.back().azimuth;
  for (std::size_t i = 1; i < by_azimuth.size(); ++i)
    widest = std::max(widest, by_azimuth[i].azimuth - by_azimuth[i - 1].azimuth);
  return widest <= widest_gap;
}

// The strings about this one by azimuth, without modules; nothing when they are no ring.
std::vector<Neighbour> ring_of(int string, const Detector& detector, const EmitterRule& rule) {
  const Eigen::Vector2d centre = detector.strings().at(string);
  std::vector<Neighbour> ring;
  for (const auto& [other, place] : detector.strings()) {
    const Eigen::Vector2d way = place - centre;
    if (other == string || way.norm() > rule.farthest) continue;
    if (way.norm() < rule.nearest) return {};
    ring.push_back({other, way.norm(), azimuth_of(way), {}});
  }
  std::sort(ring.begin(), ring.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.azimuth < b.azimuth; });
  if (ring.size() != ring_size || !all_around(ring)) return {};
  return ring;
}

// Modules of a string that see light, at most so far from a depth.
std::vector<std::uint32_t> modules_near(int string, double depth, double difference,
                                        const Detector& detector) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < detector.size(); ++i) {
    const Module& module = detector.modules()[i];
    if (module.id.string == string && module.on && std::abs(depth_of(module) - depth) <= difference)
      found.push_back(i);
  }
  return found;
}

// The string's module that is nearest to a depth; none when it lies beyond the range.
std::optional<std::uint32_t> module_at(int string, double depth, const Detector& detector,
                                       const EmitterRule& rule) {
  std::optional<std::uint32_t> nearest;
  const auto off = [&](std::uint32_t i) { return std::abs(depth_of(detector.modules()[i]) - depth); };
  for (const std::uint32_t i :
       modules_near(string, (rule.top + rule.bottom) / 2, (rule.bottom - rule.top) / 2, detector))
    if (!nearest || off(i) < off(*nearest)) nearest = i;
  return nearest;
}

std::optional<Emitter> emitter_at(int string, double depth, const Detector& detector,
                                  const EmitterRule& rule) {
  const auto flasher = module_at(string, depth, detector, rule);
  if (!flasher) return {};
  const Module& module = detector.modules()[*flasher];
  Emitter emitter{module.id, depth_of(module), ring_of(string, detector, rule)};
  if (emitter.neighbours.empty()) return {};
  for (Neighbour& neighbour : emitter.neighbours) {
    neighbour.modules = modules_near(neighbour.string, emitter.depth, rule.depth_difference, detector);
    if (neighbour.modules.empty()) return {};
  }
  return emitter;
}

}  // namespace

std::vector<Emitter> choose_emitters(const Detector& detector, const EmitterRule& rule) {
  std::vector<int> strings;
  for (const auto& [string, place] : detector.strings())
    if (emitter_at(string, (rule.top + rule.bottom) / 2, detector, rule)) strings.push_back(string);
  const std::size_t count = std::min(rule.count, strings.size());
  if (count == 0)
    throw NoResult(fmt::format(
        "detector {}: no string with a module from {:g} to {:g} m depth has six neighbours all around it, "
        "{:g} to {:g} m away, and none nearer",
        detector.name(), rule.top, rule.bottom, rule.nearest, rule.farthest));
  std::vector<Emitter> emitters;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    const int string = strings[(2 * k + 1) * strings.size() / (2 * count)];
    const auto emitter = emitter_at(string, rule.top + share * (rule.bottom - rule.top), detector, rule);
    // A neighbour's few modules may be too far from this depth.
    if (emitter) emitters.push_back(*emitter);
  }
  if (emitters.empty())
    throw NoResult(fmt::format("detector {}: the neighbours of its flashers have no modules at their depth",
                               detector.name()));
  return emitters;
}

std::string text_of(const Emitter& emitter) {
  return fmt::format("{},{} at {:.0f} m", emitter.module.string, emitter.module.dom, emitter.depth);
}

Emitter narrowed(const Emitter& emitter, double depth_difference, const Detector& detector) {
  Emitter result = emitter;
  for (Neighbour& neighbour : result.neighbours)
    neighbour.modules = modules_near(neighbour.string, emitter.depth, depth_difference, detector);
  return result;
}

RunRequest ring_flash(const Emitter& emitter, double photons, std::uint64_t seed, std::uint64_t stream,
                      int threads) {
  RunRequest request;
  request.run.module = emitter.module;
  request.run.leds = {LedPattern::Kind::ring, 0};
  // Only the middle of the LED's line is simulated.
  request.photons = photons * reference_led_share;
  request.run.photons = request.photons;
  request.oversize = oversize;
  request.seed = seed;
  request.stream = stream;
  request.threads = threads;
  return request;
}

}  // namespace floe

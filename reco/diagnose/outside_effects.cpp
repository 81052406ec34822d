#include "reco/diagnose/outside_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "data/base/vec3.h"

namespace floe {

namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

OutsideEffect glow(std::mt19937_64& random) {
  const double share = uniform(random, 0.15, 0.3), time = uniform(random, 200, 500);  // [ns]
  return {"glow", fmt::format("{:.0f}% of the light leaves {:.0f} ns late, on average", 100 * share, time),
          [=](std::vector<SimulatedHit>& hits, const FlasherRun&, std::mt19937_64& draw) {
            std::exponential_distribution<double> delay(1 / time);
            for (SimulatedHit& hit : hits)
              if (uniform(draw, 0, 1) < share) hit.time += static_cast<float>(delay(draw));
          }};
}

// The straight way stands for all others.
OutsideEffect curtain(const Detector& detector, const std::vector<FlasherRun>& runs,
                      std::mt19937_64& random) {
  const double share = uniform(random, 0.3, 0.6), azimuth = uniform(random, 0, 2 * pi);
  Vec3 middle = Vec3::Zero();
  for (const FlasherRun& run : runs)
    middle += detector.modules()[detector.index_of(run.module)].position / static_cast<double>(runs.size());
  const Vec3 across(std::cos(azimuth), std::sin(azimuth), 0);
  const double place = across.dot(middle) + uniform(random, 20, 80);
  return {"curtain",
          fmt::format("a plane across azimuth {:.0f} deg takes {:.0f}% of the light", azimuth / degree,
                      100 * share),
          [=, &detector](std::vector<SimulatedHit>& hits, const FlasherRun& run, std::mt19937_64& draw) {
            const auto beyond = [&](const Vec3& at) { return across.dot(at) > place; };
            const bool from = beyond(detector.modules()[detector.index_of(run.module)].position);
            std::erase_if(hits, [&](const SimulatedHit& hit) {
              return beyond(detector.modules()[hit.module].position) != from && uniform(draw, 0, 1) < share;
            });
          }};
}

OutsideEffect bright_loss(std::mt19937_64& random) {
  const double half = uniform(random, 300, 1000);
  return {"bright-loss", fmt::format("modules with {:.0f} photons lose half of them", half),
          [=](std::vector<SimulatedHit>& hits, const FlasherRun&, std::mt19937_64& draw) {
            std::map<std::uint32_t, double> seen;
            for (const SimulatedHit& hit : hits) seen[hit.module] += 1;
            std::erase_if(hits, [&](const SimulatedHit& hit) {
              return uniform(draw, 0, 1) > 1 / (1 + seen[hit.module] / half);
            });
          }};
}

OutsideEffect late_loss(std::mt19937_64& random) {
  const double share = uniform(random, 0.3, 0.6), after = uniform(random, 200, 400);
  return {"late-loss",
          fmt::format("modules lose {:.0f}% of what comes {:.0f} ns after their first photon", 100 * share,
                      after),
          [=](std::vector<SimulatedHit>& hits, const FlasherRun&, std::mt19937_64& draw) {
            std::map<std::uint32_t, float> first;
            for (const SimulatedHit& hit : hits) {
              const auto [known, is_new] = first.try_emplace(hit.module, hit.time);
              if (!is_new) known->second = std::min(known->second, hit.time);
            }
            std::erase_if(hits, [&](const SimulatedHit& hit) {
              return hit.time > first[hit.module] + static_cast<float>(after) && uniform(draw, 0, 1) < share;
            });
          }};
}

}  // namespace

OutsideEffect draw_outside_effect(int number, const Detector& detector, const std::vector<FlasherRun>& runs,
                                  std::mt19937_64& random) {
  switch (number % 4) {
    case 0:
      return glow(random);
    case 1:
      return curtain(detector, runs, random);
    case 2:
      return bright_loss(random);
    default:
      return late_loss(random);
  }
}

}  // namespace floe

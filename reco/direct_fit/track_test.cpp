#include "reco/direct_fit/track_test.h"

#include <cmath>
#include <cstdio>

#include "data/base/constants.h"

namespace floe {

std::string TrackTest::words() const {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "the hits move along a line of %.0f m (rms) at %.2f of the speed of light, which fits their times "
      "to %.0f ns, a single point to %.0f ns",
      length, speed / speed_of_light, track_spread, cascade_spread);
  return text;
}

TrackTest test_for_track(const EventData& data, const PointSeed& point) {
  const auto& modules = data.detector().modules();
  Vec3 mean_place = Vec3::Zero();
  double mean_time = 0;
  const std::vector<std::size_t> hit = data.brightest(data.lit().size());
  const double n = double(hit.size());
  for (const std::size_t i : hit) {
    const ModuleData& lit = data.lit()[i];
    mean_place += modules[lit.module].position / n;
    mean_time += lit.times.front() / n;
  }
  Vec3 covariance = Vec3::Zero();
  double variance = 0;
  for (const std::size_t i : hit) {
    const ModuleData& lit = data.lit()[i];
    const double t = lit.times.front() - mean_time;
    covariance += (modules[lit.module].position - mean_place) * t;
    variance += t * t;
  }
  TrackTest test;
  if (variance <= 0) return test;
  const Vec3 velocity = covariance / variance;
  test.speed = velocity.norm();
  if (test.speed <= 0) return test;

  double along = 0, across = 0, track = 0, cascade = 0, cascade_mean = 0;
  for (const std::size_t i : hit) {
    const ModuleData& lit = data.lit()[i];
    const Vec3 place = modules[lit.module].position - mean_place;
    const double l = place.dot(velocity) / test.speed, t = lit.times.front() - mean_time;
    along += l * l;
    across += 0.5 * (place.squaredNorm() - l * l);
    track += (t - l / test.speed) * (t - l / test.speed);
    const double late = lit.times.front() - point.time -
                        light_slowness() * soft_distance(modules[lit.module].position - point.position);
    cascade_mean += late / n;
    cascade += late * late;
  }
  test.length = std::sqrt(along / n);
  test.elongation = std::sqrt(along / std::max(across, 1.0));
  test.track_spread = std::sqrt(track / n);
  test.cascade_spread = std::sqrt(std::max(0.0, cascade / n - cascade_mean * cascade_mean));
  test.track_like = test.speed > 0.4 * speed_of_light && test.speed < 1.3 * speed_of_light &&
                    test.length > 80 && test.elongation > 1.5 && test.track_spread < test.cascade_spread;
  return test;
}

}  // namespace floe

#include "propagation/effects/rising_layers.h"

#include <algorithm>
#include <cmath>

#include "propagation/ice/ice_files.h"
#include "propagation/ice/tilt.h"

namespace floe {

namespace {

constexpr double metres_per_kilometre = 1000;

// 1D tilt is measured from a string. The one nearest to the frame's origin is what published tilts take.
int central_string(const Detector& detector) {
  const auto& strings = detector.strings();
  return std::min_element(strings.begin(), strings.end(),
                          [](const auto& a, const auto& b) { return a.second.norm() < b.second.norm(); })
      ->first;
}

// Two points will do, as lines continue beyond their ends. The second belongs to no string.
TiltLines flat_lines(const ModelParts& model) {
  TiltLines lines{{central_string(model.detector), 0}, {0, metres_per_kilometre}, {}, {}};
  for (const IceLayerRow& row : model.ice.layers) lines.depths.push_back(row.depth);
  if (lines.depths.size() == 1) lines.depths.push_back(lines.depths.front() + 1);
  lines.shifts.assign(lines.depths.size(), {0, 0});
  return lines;
}

// How far each grid point is along the direction of 1D tilt, from the frame's origin [m].
std::vector<double> distances_of(const TiltMap& map) {
  std::vector<double> distances;
  for (int j = 0; j < map.second.count; ++j)
    for (int i = 0; i < map.first.count; ++i) {
      if (!ice_files::is_kept(map, i, j)) continue;
      const double p = map.first.start + i * map.first.step, q = map.second.start + j * map.second.step;
      distances.push_back(p * std::cos(map.first.direction_deg * degree - tilt_lines_direction) +
                          q * std::cos(map.second.direction_deg * degree - tilt_lines_direction));
    }
  return distances;
}

}  // namespace

void add_rise(const std::function<double(double depth)>& slope, ModelParts& model) {
  const auto add = [&](auto& tilt, const std::vector<double>& distances) {
    for (std::size_t row = 0; row < tilt.depths.size(); ++row) {
      const double rise = slope(tilt.depths[row]) / metres_per_kilometre;
      for (std::size_t i = 0; i < distances.size(); ++i) tilt.shifts[row].at(i) += rise * distances[i];
    }
  };
  IceTables& ice = model.ice;
  if (ice.tilt_map) {  // which is in use where a model has both
    add(*ice.tilt_map, distances_of(*ice.tilt_map));
    return;
  }
  if (!ice.tilt_lines) ice.tilt_lines = flat_lines(model);
  add(*ice.tilt_lines, ice.tilt_lines->distances);
}

}  // namespace floe

#include <algorithm>
#include <cmath>

#include "propagation/effects/effect.h"
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

// Rises by `slope`; two points will do, as lines continue beyond their ends. The second belongs to no string.
TiltLines rising_lines(double slope, const ModelParts& model) {
  const double top = model.ice.layers.front().depth, bottom = model.ice.layers.back().depth;
  const std::vector<double> shifts{0, slope};
  return {{central_string(model.detector), 0},
          {0, metres_per_kilometre},
          {top, bottom > top ? bottom : top + 1},
          {shifts, shifts}};
}

void add_to_lines(double slope, TiltLines& tilt) {
  for (auto& row : tilt.shifts)
    for (std::size_t i = 0; i < row.size(); ++i) row[i] += slope / metres_per_kilometre * tilt.distances[i];
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

void add_to_map(double slope, TiltMap& tilt) {
  const std::vector<double> distances = distances_of(tilt);
  for (auto& row : tilt.shifts)
    for (std::size_t i = 0; i < row.size(); ++i) row[i] += slope / metres_per_kilometre * distances.at(i);
}

class Tilt final : public Effect {
 public:
  std::string name() const override { return "tilt"; }
  std::string description() const override {
    return "Layers rise or fall along 225 deg, in addition to the tilt that the model has";
  }
  std::string source() const override { return "arXiv:1301.5361, arXiv:2307.13951"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"slope", "m/km", "added to the layers' rise along 225 deg", 0, -300, 300}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double slope = values[0];
    if (slope == 0) return;
    IceTables& ice = model.ice;
    if (ice.tilt_map)  // which is in use where a model has both
      add_to_map(slope, *ice.tilt_map);
    else if (ice.tilt_lines)
      add_to_lines(slope, *ice.tilt_lines);
    else
      ice.tilt_lines = rising_lines(slope, model);
  }
};

}  // namespace

const Effect& tilt_effect() {
  static const Tilt effect;
  return effect;
}

}  // namespace floe

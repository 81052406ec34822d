#include "geometry/column_finder.h"

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "geometry/crossing_order.h"

namespace floe {

namespace {

constexpr float column_rounding = 0.01F;  // of single precision, some kilometres from the origin [m]

// Whether a segment's nearest point to a vertical line through (x, y) is within `distance` of it.
bool passes_line(const Vec3f& origin, const Vec3f& direction, float length, float x, float y,
                 float distance) {
  const float dx = x - origin.x(), dy = y - origin.y();
  const float square = direction.x() * direction.x() + direction.y() * direction.y();
  const float along = dx * direction.x() + dy * direction.y();
  const float t = along <= 0 ? 0 : along >= length * square ? length : along / square;
  const float ax = dx - t * direction.x(), ay = dy - t * direction.y();
  return ax * ax + ay * ay <= distance * distance;
}

}  // namespace

ColumnFinder::ColumnFinder(const Detector& detector, double oversize)
    : oversize_(static_cast<float>(oversize)),
      reach_(static_cast<float>(oversize * module_radius) + column_rounding),
      places_(detector.size()) {
  check_oversize(oversize);
  for (const ModuleColumn& column : columns_of(detector))
    for (std::size_t i = 0; i < column.modules.size(); ++i) {
      const std::uint32_t module = column.modules[i].second;
      places_[module] = {detector.modules()[module].position.cast<float>(), 0,
                         i + 1 < column.modules.size() ? column.modules[i + 1].second : none,
                         i > 0 ? column.modules[i - 1].second : none};
      for (const auto& [height, other] : column.modules) {
        const auto apart = detector.modules()[other].position - detector.modules()[module].position;
        places_[module].column_radius =
            std::max(places_[module].column_radius, static_cast<float>(apart.head<2>().norm()));
      }
    }
}

void ColumnFinder::find(std::uint32_t module, const Vec3f& origin, const Vec3f& direction, float length,
                        std::vector<ModuleCrossing>& found) const {
  // A module is met where the segment is nearest to its centre, at most a module's radius beyond the end.
  const Place& start = places_[module];
  const float longer = length + static_cast<float>(module_radius) + column_rounding;
  if (!passes_line(origin, direction, longer, start.centre.x(), start.centre.y(),
                   reach_ + start.column_radius))
    return;
  const float end = origin.z() + longer * direction.z();
  const float low = std::min(origin.z(), end) - reach_, high = std::max(origin.z(), end) + reach_;
  const std::size_t before = found.size();
  const auto try_module = [&](std::uint32_t index) {
    ModuleCrossing crossing{index, 0, {}};
    if (cross_module(places_[index].centre, oversize_, origin, direction, length, crossing))
      found.push_back(crossing);
  };
  for (std::uint32_t i = module; i != none && places_[i].centre.z() <= high; i = places_[i].above)
    try_module(i);
  for (std::uint32_t i = start.below; i != none && places_[i].centre.z() >= low; i = places_[i].below)
    try_module(i);
  sort_crossings(found, before);
}

}  // namespace floe

#include "geometry/module_columns.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace floe {

namespace {

constexpr float widest = 3;  // largest radius of a column [m]

using Square = std::pair<int, int>;
Square square_of(const Vec3f& position) {
  return {static_cast<int>(std::floor(position.x() / widest)),
          static_cast<int>(std::floor(position.y() / widest))};
}

}  // namespace

// A module joins the first column whose founder is near enough; founders are found by squares of that size.
std::vector<ModuleColumn> columns_of(const Detector& detector) {
  std::vector<ModuleColumn> columns;
  std::map<Square, std::vector<std::size_t>> founded_in;
  for (std::size_t i = 0; i < detector.size(); ++i) {
    const Vec3f position = detector.modules()[i].position.cast<float>();
    const Square square = square_of(position);
    const auto distance = [&](std::size_t column) {
      return std::hypot(position.x() - columns[column].x, position.y() - columns[column].y);
    };
    std::size_t joined = columns.size();
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if (const auto near = founded_in.find({square.first + dx, square.second + dy});
            near != founded_in.end())
          for (const std::size_t column : near->second)
            if (column < joined && distance(column) <= widest) joined = column;
    if (joined == columns.size()) {
      columns.push_back({position.x(), position.y(), 0, {}});
      founded_in[square].push_back(joined);
    }
    columns[joined].radius = std::max(columns[joined].radius, distance(joined));
    columns[joined].modules.emplace_back(position.z(), static_cast<std::uint32_t>(i));
  }
  for (ModuleColumn& column : columns) std::sort(column.modules.begin(), column.modules.end());
  return columns;
}

}  // namespace floe

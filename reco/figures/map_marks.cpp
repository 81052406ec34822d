#include "reco/figures/map_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace floe {

std::string map_shade(double share_of_range) {
  constexpr std::array<std::array<double, 3>, 4> shades{
      {{58, 124, 178}, {126, 177, 213}, {198, 219, 239}, {255, 255, 255}}};
  const double place = std::clamp(share_of_range, 0.0, 1.0) * (shades.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), shades.size() - 2);
  const double share = place - static_cast<double>(i);
  const auto part = [&](std::size_t k) {
    return static_cast<int>(std::lround((1 - share) * shades[i][k] + share * shades[i + 1][k]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

void draw_cross(Svg& svg, const Svg::Point& place) {
  const auto [x, y] = place;
  svg.line({x - 8, y}, {x + 8, y}, {"#ffffff", 4, ""});
  svg.line({x, y - 8}, {x, y + 8}, {"#ffffff", 4, ""});
  svg.line({x - 6.5, y}, {x + 6.5, y}, {"#10202c", 1.6, ""});
  svg.line({x, y - 6.5}, {x, y + 6.5}, {"#10202c", 1.6, ""});
}

void draw_frame(Svg& svg, const Svg::Point& corner, double width, double height) {
  const auto [x, y] = corner;
  svg.line({x, y}, {x + width, y}, frame_stroke);
  svg.line({x + width, y}, {x + width, y + height}, frame_stroke);
  svg.line({x + width, y + height}, {x, y + height}, frame_stroke);
  svg.line({x, y + height}, {x, y}, frame_stroke);
}

}  // namespace floe

#include "reco/direct_fit/sky_map_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"

namespace floe {
namespace {

constexpr double wanted_width = 480, left = 78, top = 76, bottom = 76, right = 130;
constexpr double bar_gap = 26, bar_width = 18;
constexpr const char* grey = "#666666";
constexpr const char* red = "#d1495b";
constexpr const char* unknown_colour = "#e4e4e4";

struct ContourStyle {
  double share;
  Stroke stroke;
};
const std::array<ContourStyle, 3> contour_styles{
    {{0.5, {"#10202c", 2, ""}}, {0.9, {"#10202c", 1.8, "7 3"}}, {0.99, {"#10202c", 1.6, "2 3"}}}};

const double shade_range = 1.25 * level_of(0.99);  // range of the shades in delta -ln L

// From dark at the best to white.
std::string shade_of(double delta) {
  if (!std::isfinite(delta)) return unknown_colour;
  return map_shade(delta / shade_range);
}

// From the map to pixels of the picture; the map's own pixels are whole ones of the picture, or seams show.
struct Panel {
  explicit Panel(const SkyMap& map)
      : side(std::max(2.0, std::floor(wanted_width / map.pixels))),
        width(side * map.pixels),
        scale(side / map.step) {}

  Svg::Point at(const TangentPoint& point) const {
    return {left + width / 2 + point.first * scale, top + width / 2 + point.second * scale};
  }
  bool holds(const Svg::Point& place) const {
    return place.first >= left && place.first <= left + width && place.second >= top &&
           place.second <= top + width;
  }

  double side, width, scale;
};

void draw_pixels(Svg& svg, const Panel& panel, const SkyMap& map) {
  for (int row = 0; row < map.pixels; ++row)
    for (int column = 0; column < map.pixels; ++column)
      svg.rectangle({left + panel.side * column, top + panel.side * row}, panel.side, panel.side,
                    shade_of(map.at(row, column)));
}

// Beside the line's highest point, on a light ground.
void label_contour(Svg& svg, const std::vector<Svg::Point>& line, const std::string& words) {
  const auto highest = std::min_element(line.begin(), line.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  const double x = highest->first, y = std::max(highest->second - 5, top + 12);
  const std::array<Svg::Point, 4> ground{
      {{x - 15, y - 10}, {x + 15, y - 10}, {x + 15, y + 3}, {x - 15, y + 3}}};
  svg.area(ground, "#ffffff", 0.7);
  svg.text({x, y}, words, 11.5, Anchor::middle, "#10202c", true);
}

void draw_contours(Svg& svg, const Panel& panel, const SkyMap& map) {
  for (const ContourStyle& style : contour_styles) {
    std::vector<Svg::Point> longest;
    for (const std::vector<TangentPoint>& contour : contours(map, level_of(style.share))) {
      std::vector<Svg::Point> line;
      for (const TangentPoint& point : contour) line.push_back(panel.at(point));
      svg.polyline(line, style.stroke);
      if (line.size() > longest.size()) longest = std::move(line);
    }
    if (!longest.empty()) label_contour(svg, longest, fmt::format("{:.0f}%", 100 * style.share));
  }
}

void draw_truth(Svg& svg, const Svg::Point& place) {
  const auto [x, y] = place;
  svg.line({x - 5, y - 5}, {x + 5, y + 5}, {red, 2.4, ""});
  svg.line({x - 5, y + 5}, {x + 5, y - 5}, {red, 2.4, ""});
}

void draw_axes(Svg& svg, const Panel& panel, const SkyMap& map) {
  const double low = top + panel.width, half = 0.5 * map.pixels * map.step / degree;
  for (const double tick : round_ticks(-half, half, 6)) {
    const std::string words = tick == 0 ? "0" : fmt::format("{:+g}", tick);
    const auto [x, y] = panel.at({tick * degree, tick * degree});
    svg.line({x, low}, {x, low + 5}, frame_stroke);
    svg.text({x, low + 18}, words, 11, Anchor::middle, grey);
    svg.line({left - 5, y}, {left, y}, frame_stroke);
    svg.text({left - 8, y + 4}, words, 11, Anchor::end, grey);
  }
  svg.text({left + panel.width / 2, low + 36}, "(azimuth - best) x sin(zenith) [deg]", 12.5, Anchor::middle);
  svg.text({left - 52, top + panel.width / 2}, "zenith - best [deg], upwards falling", 12.5, Anchor::middle,
           "#222222", false, true);
}

void draw_colour_bar(Svg& svg, const Panel& panel, const SkyMap& map) {
  const double x = left + panel.width + bar_gap, low = top + panel.width, end = x + bar_width;
  const auto height_of = [&](double delta) { return low - delta / shade_range * panel.width; };
  for (int i = 0; i < map.pixels; ++i)
    svg.rectangle({x, low - panel.side * (i + 1)}, bar_width, panel.side,
                  shade_of((i + 0.5) / map.pixels * shade_range));
  draw_frame(svg, {x, top}, bar_width, panel.width);
  for (const double tick : round_ticks(0, shade_range, 6)) {
    svg.line({end, height_of(tick)}, {end + 5, height_of(tick)}, frame_stroke);
    svg.text({end + 8, height_of(tick) + 4}, fmt::format("{:g}", tick), 11, Anchor::start, grey);
  }
  for (const ContourStyle& style : contour_styles) {
    const double y = height_of(level_of(style.share));
    svg.line({x, y}, {end, y}, style.stroke);
  }
  svg.text({end + 44, top + panel.width / 2}, "-ln L above the best", 12.5, Anchor::middle, "#222222", false,
           true);
}

void draw_legend(Svg& svg, const Panel& panel, bool with_truth, bool with_unknown) {
  const double y = top + panel.width + 60;
  double x = left;
  const auto entry = [&](const std::string& words) {
    svg.text({x + 14, y + 4}, words, 12);
    x += 44 + 6.5 * static_cast<double>(words.size());
  };
  draw_cross(svg, {x, y});
  entry("best");
  if (with_truth) {
    draw_truth(svg, {x, y});
    entry("truth");
  }
  if (with_unknown) {
    svg.rectangle({x - 7, y - 6}, 14, 12, unknown_colour);
    entry("not known");
  }
}

}  // namespace

std::string figure_of_sky_map(const SkyMap& map, const std::string& title,
                              const std::optional<Origin>& truth) {
  const Panel panel(map);
  Svg svg(left + panel.width + right, top + panel.width + bottom);
  svg.text({left, 30}, title, 16, Anchor::start, "#222222", true);
  svg.text({left, 54},
           fmt::format("best: zenith {:.2f} deg, azimuth {:.2f} deg; {}, {}", map.zenith / degree,
                       map.azimuth / degree, words_of_area(map, 0.5), words_of_area(map, 0.9)),
           12.5, Anchor::start, grey);
  if (map.errors_are_wider)
    svg.text({left, 70}, "of this minimum alone: the fit's errors are wider", 12.5, Anchor::start, "#c0392b");
  draw_pixels(svg, panel, map);
  draw_contours(svg, panel, map);
  draw_cross(svg, panel.at({0, 0}));
  const bool true_inside = truth && panel.holds(panel.at(map.point_of(*truth)));
  if (true_inside) draw_truth(svg, panel.at(map.point_of(*truth)));
  draw_frame(svg, {left, top}, panel.width, panel.width);
  draw_axes(svg, panel, map);
  draw_colour_bar(svg, panel, map);
  draw_legend(svg, panel, true_inside,
              std::any_of(map.delta_neg_llh.begin(), map.delta_neg_llh.end(),
                          [](double delta) { return !std::isfinite(delta); }));
  return svg.str();
}

}  // namespace floe

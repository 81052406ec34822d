#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"
#include "reco/ice_fit/scan.h"

namespace floe {

namespace {

constexpr double wanted_width = 480, left = 92, top = 98, bottom = 84, right = 136;
constexpr double bar_gap = 26, bar_width = 18;
constexpr int bar_steps = 120, fine_steps = 120;
constexpr const char* grey = "#666666";
constexpr const char* red = "#d1495b";

struct ContourStyle {
  double level;
  const char* words;
  Stroke stroke;
};
const std::array<ContourStyle, 2> contour_styles{
    {{level_68, "68%", {"#10202c", 2, ""}}, {level_95, "95%", {"#10202c", 1.8, "7 3"}}}};

// Shades go with the square root, as errors do: the minimum and what lies far from it are both seen.
struct Shades {
  double range;  // of -ln L above the minimum

  double share(double delta) const { return std::sqrt(std::clamp(delta / range, 0.0, 1.0)); }
  std::string of(double delta) const { return map_shade(share(delta)); }
};

// From the grid to pixels of the picture. Points are in the middle of cells; their sides are whole pixels, or
// seams show.
struct Panel {
  explicit Panel(const IceScan& s)
      : scan(s),
        cell_width(std::max(2.0, std::floor(wanted_width / s.x.count))),
        cell_height(std::max(2.0, std::floor(wanted_width / s.y.count))),
        width(cell_width * s.x.count),
        height(cell_height * s.y.count) {}

  Svg::Point at(const GridPlace& place) const {
    return {left + (place.first + 0.5) * cell_width, top + height - (place.second + 0.5) * cell_height};
  }
  Svg::Point at_values(double x, double y) const {
    return at({(x - scan.x.low) / scan.x.step(), (y - scan.y.low) / scan.y.step()});
  }
  bool holds(const Svg::Point& place) const {
    return place.first >= left && place.first <= left + width && place.second >= top &&
           place.second <= top + height;
  }

  const IceScan& scan;
  double cell_width, cell_height, width, height;
};

NumberGrid above_minimum(const IceScan& scan) {
  NumberGrid grid = scan.neg_llh;
  for (double& value : grid.values) value -= scan.minimum.value;
  return grid;
}

void draw_cells(Svg& svg, const Panel& panel, const NumberGrid& grid, const Shades& shades) {
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto [x, y] = panel.at({column - 0.5, row + 0.5});
      svg.rectangle({x, y}, panel.cell_width, panel.cell_height, shades.of(grid.at(row, column)));
    }
}

void draw_contours(Svg& svg, const Panel& panel, const NumberGrid& grid) {
  const int parts = 1 + fine_steps / std::min(grid.rows, grid.columns);
  const NumberGrid fine = refined(grid, parts);
  for (const ContourStyle& style : contour_styles)
    for (const std::vector<GridPlace>& contour : contour_lines(fine, style.level)) {
      std::vector<Svg::Point> line;
      for (const auto& [column, row] : contour) line.push_back(panel.at({column / parts, row / parts}));
      svg.polyline(line, style.stroke);
    }
}

void draw_base(Svg& svg, const Svg::Point& place) {
  svg.circle(place, 5.5, "#ffffff");
  svg.circle(place, 4, red);
}

std::string title_of(const IceParameter& parameter) {
  if (!parameter.family.empty()) return parameter.name + ", factor";
  return parameter.unit.empty() ? parameter.name : fmt::format("{} [{}]", parameter.name, parameter.unit);
}

void draw_axes(Svg& svg, const Panel& panel) {
  const IceScan& scan = panel.scan;
  const double low = top + panel.height;
  const auto ticks = [](const ScanAxis& axis) {
    return round_ticks(axis.low - axis.step() / 2, axis.high + axis.step() / 2, 6);
  };
  for (const double tick : ticks(scan.x)) {
    const double x = panel.at_values(tick, scan.y.low).first;
    svg.line({x, low}, {x, low + 5}, frame_stroke);
    svg.text({x, low + 18}, fmt::format("{:g}", tick), 11, Anchor::middle, grey);
  }
  for (const double tick : ticks(scan.y)) {
    const double y = panel.at_values(scan.x.low, tick).second;
    svg.line({left - 5, y}, {left, y}, frame_stroke);
    svg.text({left - 8, y + 4}, fmt::format("{:g}", tick), 11, Anchor::end, grey);
  }
  svg.text({left + panel.width / 2, low + 38}, title_of(scan.x.parameter), 12.5, Anchor::middle);
  svg.text({left - 62, top + panel.height / 2}, title_of(scan.y.parameter), 12.5, Anchor::middle, "#222222",
           false, true);
}

void draw_colour_bar(Svg& svg, const Panel& panel, const Shades& shades) {
  const double x = left + panel.width + bar_gap, low = top + panel.height, end = x + bar_width;
  const auto height_of = [&](double delta) { return low - shades.share(delta) * panel.height; };
  for (int i = 0; i < bar_steps; ++i)
    svg.rectangle({x, low - panel.height * (i + 1) / bar_steps}, bar_width, panel.height / bar_steps + 0.5,
                  map_shade((i + 0.5) / bar_steps));
  draw_frame(svg, {x, top}, bar_width, panel.height);
  // Round numbers of the square root: evenly spaced.
  for (const double root : round_ticks(0, std::sqrt(shades.range), 6)) {
    const double y = height_of(root * root);
    svg.line({end, y}, {end + 5, y}, frame_stroke);
    svg.text({end + 8, y + 4}, fmt::format("{:g}", root * root), 11, Anchor::start, grey);
  }
  for (const ContourStyle& style : contour_styles)
    if (style.level < shades.range)
      svg.line({x, height_of(style.level)}, {end, height_of(style.level)}, style.stroke);
  svg.text({end + 56, top + panel.height / 2}, "-ln L above the minimum", 12.5, Anchor::middle, "#222222",
           false, true);
}

void draw_legend(Svg& svg, const Panel& panel, bool with_base) {
  const double y = top + panel.height + 66;
  double x = left;
  const auto entry = [&](const std::string& words) {
    svg.text({x + 16, y + 4}, words, 12);
    x += 52 + 6.5 * static_cast<double>(words.size());
  };
  draw_cross(svg, {x, y});
  entry(panel.scan.minimum.found ? "minimum" : "lowest point");
  if (with_base) {
    draw_base(svg, {x, y});
    entry("base model");
  }
  for (const ContourStyle& style : contour_styles) {
    svg.line({x - 14, y}, {x + 11, y}, style.stroke);
    entry(style.words);
  }
}

std::string place_words(const IceScan& scan) {
  const QuadraticMinimum& m = scan.minimum;
  const std::string &x = scan.x.parameter.name, &y = scan.y.parameter.name;
  if (!m.found) return fmt::format("lowest point: {} {:.4g}, {} {:.4g}", x, m.x, y, m.y);
  return fmt::format("minimum: {} {:.4g} +- {:.2g}, {} {:.4g} +- {:.2g}", x, m.x, m.x_error, y, m.y,
                     m.y_error);
}

std::string quality_words(const IceScan& scan) {
  std::string words;
  if (scan.minimum.found) words += fmt::format("correlation {:.2f}; ", scan.minimum.correlation);
  if (scan.minimum.at_edge) words += "at the edge of the grid; ";
  return words + fmt::format("{} run{}, {} bins; noise of differences of -ln L {:.2g}", scan.runs.size(),
                             scan.runs.size() == 1 ? "" : "s", scan.bins, scan.noise);
}

}  // namespace

std::string scan_picture(const IceScan& scan, const std::string& title) {
  const Panel panel(scan);
  const NumberGrid grid = above_minimum(scan);
  const Shades shades{std::max(1e-6, *std::max_element(grid.values.begin(), grid.values.end()))};
  Svg svg(left + panel.width + right, top + panel.height + bottom);
  svg.text({left, 30}, title, 16, Anchor::start, "#222222", true);
  svg.text({left, 54}, place_words(scan), 12, Anchor::start, grey);
  svg.text({left, 74}, quality_words(scan), 12, Anchor::start, grey);
  draw_cells(svg, panel, grid, shades);
  draw_contours(svg, panel, grid);
  const Svg::Point base = panel.at_values(scan.x.base(), scan.y.base());
  if (panel.holds(base)) draw_base(svg, base);
  draw_cross(svg, panel.at_values(scan.minimum.x, scan.minimum.y));
  draw_frame(svg, {left, top}, panel.width, panel.height);
  draw_axes(svg, panel);
  draw_colour_bar(svg, panel, shades);
  draw_legend(svg, panel, panel.holds(base));
  return svg.str();
}

}  // namespace floe

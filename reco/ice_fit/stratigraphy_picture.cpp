#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reco/figures/svg.h"
#include "reco/ice_fit/stratigraphy.h"

namespace floe {

namespace {

constexpr double width = 280, height = 560, left = 70, gap = 40, top = 80;
constexpr const char* grey = "#777777";
constexpr const char* blue = "#0b6fa4";

struct Panel {
  const char* title;
  const char* axis;
  std::function<double(const StratigraphyRow&)> value, base, error;
};

struct Range {
  double low, high;
  double place(double value) const { return std::clamp((value - low) / (high - low), 0.0, 1.0); }
};

Range range_of(const std::vector<StratigraphyRow>& rows, const Panel& panel) {
  double high = 0;
  for (const StratigraphyRow& row : rows)
    for (const double value : {panel.value(row) * (1 + panel.error(row)), panel.base(row)})
      if (std::isfinite(value)) high = std::max(high, value);
  return {0, high > 0 ? 1.05 * high : 1};
}

// Pieces of the curve where it is finite, as steps of one layer each.
void draw_curve(Svg& svg, const std::vector<StratigraphyRow>& rows,
                const std::function<double(const StratigraphyRow&)>& value,
                const std::function<Svg::Point(double, double)>& at, double step, const Stroke& stroke) {
  std::vector<Svg::Point> points;
  const auto finish = [&] {
    if (!points.empty()) svg.polyline(points, stroke);
    points.clear();
  };
  for (const StratigraphyRow& row : rows) {
    const double x = value(row);
    if (!std::isfinite(x)) {
      finish();
      continue;
    }
    points.push_back(at(x, row.depth - step / 2));
    points.push_back(at(x, row.depth + step / 2));
  }
  finish();
}

void draw_panel(Svg& svg, double x, const std::vector<StratigraphyRow>& rows, const Panel& panel,
                bool first) {
  const double step = rows.size() > 1 ? rows[1].depth - rows[0].depth : 10;
  const Range across = range_of(rows, panel);
  const Range down{rows.front().depth - step / 2, rows.back().depth + step / 2};
  const auto at = [&](double value, double depth) -> Svg::Point {
    return {x + width * across.place(value), top + height * down.place(depth)};
  };
  for (const double tick : round_ticks(across.low, across.high, 5)) {
    svg.line(at(tick, down.low), at(tick, down.high), {"#e5e5e5", 1, ""});
    svg.text({at(tick, 0).first, top + height + 16}, fmt::format("{:g}", tick), 11, Anchor::middle, grey);
  }
  for (const double tick : round_ticks(down.low, down.high, 8)) {
    svg.line(at(across.low, tick), at(across.high, tick), {"#e5e5e5", 1, ""});
    if (first) svg.text({x - 6, at(0, tick).second + 4}, fmt::format("{:g}", tick), 11, Anchor::end, grey);
  }
  for (const StratigraphyRow& row : rows) {
    const double value = panel.value(row), error = panel.error(row) * value;
    if (!std::isfinite(value) || !(error > 0)) continue;
    const Svg::Point corner = at(value - error, row.depth - step / 2),
                     end = at(value + error, row.depth + step / 2);
    svg.rectangle(corner, end.first - corner.first, end.second - corner.second, "#cfe3ef");
  }
  draw_curve(svg, rows, panel.base, at, step, {grey, 1.2, "4 3"});
  draw_curve(svg, rows, panel.value, at, step, {blue, 1.8, ""});
  svg.line({x, top}, {x, top + height}, {grey, 1, ""});
  svg.line({x, top + height}, {x + width, top + height}, {grey, 1, ""});
  svg.text({x + width / 2, top - 10}, panel.title, 13, Anchor::middle, "#222222", true);
  svg.text({x + width / 2, top + height + 36}, panel.axis, 12, Anchor::middle);
}

}  // namespace

std::string stratigraphy_picture(const std::vector<StratigraphyRow>& rows, const std::string& title) {
  using Row = StratigraphyRow;
  const Panel panels[] = {
      {"Scattering", "effective length at 400 nm [m]", [](const Row& r) { return r.scattering_length; },
       [](const Row& r) { return r.base_scattering_length; },
       [](const Row& r) { return r.scattering_error; }},
      {"Absorption", "length at 400 nm [m]", [](const Row& r) { return r.absorption_length; },
       [](const Row& r) { return r.base_absorption_length; },
       [](const Row& r) { return r.absorption_error; }},
      {"Crystals", "mean distance between crossings [mm]",
       [](const Row& r) { return crystal_size(r.strength); },
       [](const Row& r) { return crystal_size(r.base_strength); },
       [](const Row& r) { return r.strength_error; }}};
  Svg svg(left + 3 * (width + gap) + 10, top + height + 60);
  svg.text({left, 28}, title, 16, Anchor::start, "#222222", true);
  svg.text({left, 48},
           "Line: fitted, with its error; dashed: the model that the fit began with. Down: depth [m]", 12,
           Anchor::start, grey);
  if (rows.empty()) return svg.str();
  double x = left;
  for (const Panel& panel : panels) {
    draw_panel(svg, x, rows, panel, x == left);
    x += width + gap;
  }
  return svg.str();
}

}  // namespace floe

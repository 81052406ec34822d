#include "reco/crystal/pattern_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

constexpr const char* grey = "#666666";
constexpr double top = 92, sphere_radius = 215, sphere_x = 270, sphere_y = top + 235;
constexpr double panel_x = 610, panel_width = 400, panel_height = 180, gap = 84;
constexpr std::size_t drawn_patterns = 7, drawn_photons = 600;
constexpr std::array<const char*, 7> colours{"#0b6fa4", "#d1495b", "#3c8d40", "#e08e1b",
                                             "#7a4fa3", "#2a9d8f", "#555555"};

// First directions lie on the equator, the flow at longitude 0; seen from longitude 45 deg, where all of them
// face the viewer. The third component is towards the viewer.
Vec3 seen(const Vec3& v) {
  const double half = std::sqrt(0.5);
  return {half * (v.x() - v.y()), v.z(), half * (v.x() + v.y())};
}

Svg::Point on_sphere(const Vec3& direction) {
  const Vec3 place = seen(direction);
  return {sphere_x + sphere_radius * place.x(), sphere_y - sphere_radius * place.y()};
}

// From the pattern's own axes, x towards the flow, to the sphere's.
Vec3 from_pattern(double angle, const Vec3& v) {
  const Vec3 n(std::cos(angle), std::sin(angle), 0), x(std::sin(angle), -std::cos(angle), 0), y(0, 0, -1);
  return v.x() * x + v.y() * y + v.z() * n;
}

// The part of a curve that faces the viewer.
void draw_near_side(Svg& svg, const std::vector<Vec3>& curve, const Stroke& stroke) {
  std::vector<Svg::Point> part;
  for (const Vec3& place : curve) {
    if (seen(place).z() >= 0) part.push_back(on_sphere(place));
    if (seen(place).z() >= 0 && &place != &curve.back()) continue;
    if (part.size() > 1) svg.polyline(part, stroke);
    part.clear();
  }
}

void draw_sphere(Svg& svg) {
  const Stroke faint{"#e4e4e4", 1, ""};
  for (int angle = 15; angle <= 165; angle += 15) {  // circles of equal angle to the flow
    std::vector<Vec3> circle;
    for (int turn = -90; turn <= 90; turn += 3)
      circle.push_back({std::cos(angle * degree), std::sin(angle * degree) * std::cos(turn * degree),
                        std::sin(angle * degree) * std::sin(turn * degree)});
    draw_near_side(svg, circle, faint);
  }
  std::vector<Svg::Point> rim;
  for (int turn = 0; turn <= 360; turn += 3)
    rim.push_back({sphere_x + sphere_radius * std::cos(turn * degree),
                   sphere_y - sphere_radius * std::sin(turn * degree)});
  svg.polyline(rim, {"#999999", 1, ""});
  std::vector<Vec3> equator;
  for (int angle = -45; angle <= 135; angle += 3)
    equator.push_back({std::cos(angle * degree), std::sin(angle * degree), 0});
  draw_near_side(svg, equator, {"#bbbbbb", 1, "3 4"});
}

void draw_flow(Svg& svg) {
  const auto [x, y] = on_sphere({1, 0, 0});
  svg.line({x, y - 118}, {x, y - 104}, {"#222222", 1.4, ""});
  svg.text({x, y - 124}, "flow", 12.5, Anchor::middle, "#222222", true);
}

std::vector<std::size_t> chosen_patterns(std::size_t count) {
  std::vector<std::size_t> chosen;
  const std::size_t step = std::max<std::size_t>(1, (count + drawn_patterns - 2) / (drawn_patterns - 1));
  for (std::size_t i = 0; i < count; i += step) chosen.push_back(i);
  return chosen;
}

void draw_pattern(Svg& svg, const CrystalPattern& pattern, const char* colour) {
  for (std::size_t i = 0; i < std::min(drawn_photons, pattern.photons.size()); ++i) {
    const Vec3 direction = from_pattern(pattern.angle, pattern.photons[i].direction);
    if (seen(direction).z() >= 0) svg.circle(on_sphere(direction), 0.9, colour);
  }
  const auto [x, y] = on_sphere(from_pattern(pattern.angle, {0, 0, 1}));
  svg.text({x, y + 108}, fmt::format("{:g}\u00b0", pattern.angle / degree), 12.5, Anchor::middle, colour,
           true);
}

struct Panel {
  double y, low, high;

  Svg::Point at(double angle, double value) const {
    const double share = (value - low) / (high - low);
    return {panel_x + angle / (pi / 2) * panel_width, y + panel_height * (1 - share)};
  }
};

void draw_axes(Svg& svg, const Panel& panel, const std::string& label) {
  for (const double tick : round_ticks(panel.low, panel.high, 5)) {
    svg.line(panel.at(0, tick), panel.at(pi / 2, tick), {"#e2e2e2", 1, ""});
    const auto [x, y] = panel.at(0, tick);
    svg.text({x - 7, y + 4}, fmt::format("{:g}", 1e3 * tick), 12, Anchor::end, grey);
  }
  for (int angle = 0; angle <= 90; angle += 15) {
    const auto [x, y] = panel.at(angle * degree, panel.low);
    svg.line({x, y}, {x, y + 4}, frame_stroke);
    svg.text({x, y + 18}, fmt::format("{}", angle), 12, Anchor::middle, grey);
  }
  draw_frame(svg, {panel_x, panel.y}, panel_width, panel_height);
  svg.text({panel_x + panel_width / 2, panel.y + panel_height + 36}, "angle to the flow [deg]", 12.5,
           Anchor::middle);
  svg.text({panel_x - 46, panel.y + panel_height / 2}, label, 12.5, Anchor::middle, "#222222", false, true);
}

using Curve = double (*)(const DiffusionStep&);
double width_x(const DiffusionStep& step) {
  return step.sigma_x;
}
double width_y(const DiffusionStep& step) {
  return step.sigma_y;
}
double deflection(const DiffusionStep& step) {
  return step.mean_x;
}

void draw_curve(Svg& svg, const Panel& panel, const BirefringenceNumbers& numbers, Curve curve,
                const Stroke& stroke) {
  std::vector<Svg::Point> points;
  for (int angle = 0; angle <= 90; ++angle) {
    const double value = curve(diffusion_step(numbers, std::cos(angle * degree)));
    points.push_back(panel.at(angle * degree, std::clamp(value, panel.low, panel.high)));
  }
  svg.polyline(points, stroke);
}

void draw_points(Svg& svg, const Panel& panel, const std::vector<AngleValue>& points, const char* colour) {
  for (const auto& [angle, value, error] : points) {
    const double low = std::max(panel.low, value - error), high = std::min(panel.high, value + error);
    svg.line(panel.at(angle, low), panel.at(angle, high), {colour, 1.2, ""});
    svg.circle(panel.at(angle, value), 3, colour);
  }
}

std::pair<double, double> range_of(const DiffusionFit& fit, std::initializer_list<std::size_t> functions) {
  double low = 0, high = 1e-4;
  for (const std::size_t i : functions)
    for (const AngleValue& point : fit.points[i]) {
      low = std::min(low, point.value - point.error);
      high = std::max(high, point.value + point.error);
    }
  return {1.08 * low, 1.08 * high};
}

void draw_fits(Svg& svg, const DiffusionFit& fit) {
  const BirefringenceNumbers fitted = fit.numbers(), published = published_birefringence();
  const auto [low_m, high_m] = range_of(fit, {2});
  const auto [low_s, high_s] = range_of(fit, {0, 1});
  const Panel mean{top, low_m, std::max(high_m, 0.005)};
  const Panel widths{top + panel_height + gap, low_s, std::max(high_s, 0.085)};
  draw_axes(svg, mean, "m_x towards the flow [mrad]");
  draw_axes(svg, widths, "width [mrad]");
  const auto series = [&](const Panel& panel, std::size_t i, Curve curve, const char* colour) {
    draw_curve(svg, panel, published, curve, {colour, 1.2, "5 4"});
    draw_curve(svg, panel, fitted, curve, {colour, 1.8, ""});
    draw_points(svg, panel, fit.points[i], colour);
  };
  series(mean, 2, deflection, colours[0]);
  series(widths, 0, width_x, colours[1]);
  series(widths, 1, width_y, colours[2]);
}

void draw_legend(Svg& svg, double y) {
  double x = panel_x;
  const auto entry = [&](const char* colour, const std::string& dashes, const std::string& words,
                         double width) {
    svg.line({x, y}, {x + 24, y}, {colour, 1.8, dashes});
    svg.text({x + 30, y + 4}, words, 12);
    x += width;
  };
  entry(colours[1], "", "sigma_x", 92);
  entry(colours[2], "", "sigma_y", 92);
  entry("#222222", "", "fitted", 84);
  entry("#222222", "5 4", "SpiceBFR v2", 100);
}

}  // namespace

std::string pattern_picture(const CrystalStudy& study, PatternEstimator estimator) {
  const double low = top + 2 * panel_height + gap;
  Svg svg(panel_x + panel_width + 24, low + 84);
  const bool core = estimator == PatternEstimator::core;
  svg.text({36, 34}, fmt::format("Diffusion patterns: {}", study.name), 16, Anchor::start, "#222222", true);
  svg.text(
      {36, 58},
      fmt::format("{} crossings, {} photons an angle; widths and deflection of {} photons, for 1000 grains",
                  study.grid.crossings, study.grid.photons, core ? "the core's" : "all"),
      12.5, Anchor::start, grey);
  draw_sphere(svg);
  draw_flow(svg);
  const auto chosen = chosen_patterns(study.patterns.size());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    draw_pattern(svg, study.patterns[chosen[i]], colours[i % colours.size()]);
  svg.text({sphere_x, low + 60}, "Directions at the end, by angle to the flow at the start", 12.5,
           Anchor::middle);
  const auto& fit = core ? study.core : study.all;
  if (fit) {
    draw_fits(svg, *fit);
    draw_legend(svg, low + 58);
  }
  return svg.str();
}

}  // namespace floe

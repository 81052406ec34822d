#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/base/vec3.h"
#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"
#include "reco/paper_figures/azimuth_light.h"

namespace floe {

namespace {

constexpr double panel_width = 400, panel_height = 230, left = 74, top = 118, gap_x = 40, gap_y = 76;
constexpr int columns = 2;
constexpr const char* grey = "#666666";
constexpr std::array<const char*, 6> colours{"#0b6fa4", "#d1495b", "#3c8d40",
                                             "#e08e1b", "#7a4fa3", "#555555"};
constexpr double apart = 3;  // between points of two flashers at one azimuth, as they are drawn [deg]

struct Frame {
  double x, y;  // upper left corner
  double low, high;

  Svg::Point at(double azimuth_deg, double ratio) const {
    const double share = std::clamp((ratio - low) / (high - low), 0.0, 1.0);
    return {x + azimuth_deg / 360 * panel_width, y + panel_height * (1 - share)};
  }
};

double scaled(const AzimuthModel& model, const AzimuthPoint& point) {
  return point.ratio / model.fit.levels[point.group];
}

// All panels share one scale.
std::pair<double, double> range_of(const AzimuthStudy& study) {
  double low = 0.9, high = 1.1;
  for (const AzimuthModel& model : study.models) {
    low = std::min(low, 1 - model.fit.amplitude());
    high = std::max(high, 1 + model.fit.amplitude());
    for (const AzimuthPoint& point : model.points) {
      low = std::min(low, scaled(model, point) * (1 - point.relative_error));
      high = std::max(high, scaled(model, point) * (1 + point.relative_error));
    }
  }
  const double margin = 0.06 * (high - low);
  return {std::max(0.0, low - margin), high + margin};
}

void draw_axes(Svg& svg, const Frame& frame, bool first_column) {
  const Stroke faint{"#e2e2e2", 1, ""};
  for (const double ratio : round_ticks(frame.low, frame.high, 6)) {
    svg.line(frame.at(0, ratio), frame.at(360, ratio), faint);
    const auto [x, y] = frame.at(0, ratio);
    if (first_column) svg.text({x - 7, y + 4}, fmt::format("{:g}", ratio), 12, Anchor::end, grey);
  }
  for (int azimuth = 0; azimuth <= 360; azimuth += 60) {
    const auto [x, y] = frame.at(azimuth, frame.low);
    svg.line({x, y}, {x, y + 4}, frame_stroke);
    svg.text({x, y + 18}, fmt::format("{}", azimuth), 12, Anchor::middle, grey);
  }
}

// Both ways along the flow.
void draw_flow(Svg& svg, const Frame& frame, double flow) {
  for (const double azimuth : {flow, flow + pi})
    svg.line(frame.at(azimuth / degree, frame.low), frame.at(azimuth / degree, frame.high),
             {"#999999", 1, "3 4"});
}

void draw_curve(Svg& svg, const Frame& frame, const AzimuthFit& fit) {
  std::vector<Svg::Point> curve;
  for (int azimuth = 0; azimuth <= 360; azimuth += 3)
    curve.push_back(frame.at(azimuth, fit.value(azimuth * degree)));
  svg.polyline(curve, {"#222222", 1.8, ""});
}

void draw_points(Svg& svg, const Frame& frame, const AzimuthModel& model, std::size_t emitters) {
  for (const AzimuthPoint& point : model.points) {
    const double side = static_cast<double>(point.group) - (static_cast<double>(emitters) - 1) / 2;
    const double azimuth = std::clamp(point.azimuth / degree + apart * side, 0.0, 360.0);
    const double ratio = scaled(model, point), error = ratio * point.relative_error;
    const char* colour = colours[point.group % colours.size()];
    svg.line(frame.at(azimuth, ratio - error), frame.at(azimuth, ratio + error), {colour, 1.2, ""});
    svg.circle(frame.at(azimuth, ratio), 3, colour);
  }
}

void draw_panel(Svg& svg, const Frame& frame, const AzimuthModel& model, const AzimuthStudy& study,
                bool first_column) {
  draw_axes(svg, frame, first_column);
  draw_flow(svg, frame, study.flow);
  draw_points(svg, frame, model, study.emitters.size());
  draw_curve(svg, frame, model.fit);
  draw_frame(svg, {frame.x, frame.y}, panel_width, panel_height);
  const AzimuthFit& fit = model.fit;
  svg.text({frame.x, frame.y - 26}, model.name, 14, Anchor::start, "#222222", true);
  // The direction of what may be noise says nothing.
  const std::string direction = fit.isotropy_p_value() < 0.01
                                    ? fmt::format(", \u03c6 {:.1f} \u00b1 {:.1f}\u00b0", fit.phase() / degree,
                                                  fit.phase_error() / degree)
                                    : "";
  svg.text({frame.x, frame.y - 9},
           fmt::format("c {:.3f} \u00b1 {:.3f}, max/min {:.2f} \u00b1 {:.2f}{}", fit.amplitude(),
                       fit.amplitude_error(), fit.max_over_min(), fit.max_over_min_error(), direction),
           12);
}

void draw_legend(Svg& svg, const AzimuthStudy& study) {
  double x = left;
  const double y = 56;
  svg.text({x, y + 4}, "Flashers:", 12, Anchor::start, grey);
  x += 66;
  for (std::size_t e = 0; e < study.emitters.size(); ++e) {
    svg.circle({x, y}, 3.5, colours[e % colours.size()]);
    svg.text({x + 9, y + 4}, text_of(study.emitters[e]), 12);
    x += 122;
  }
  svg.line({x, y}, {x + 24, y}, {"#222222", 1.8, ""});
  svg.text({x + 30, y + 4}, "1 + c cos 2(azimuth \u2212 \u03c6)", 12);
  svg.line({x + 196, y}, {x + 220, y}, {"#999999", 1, "3 4"});
  svg.text({x + 226, y + 4}, "flow", 12);
}

}  // namespace

std::string azimuth_picture(const AzimuthStudy& study, const std::string& title) {
  const int rows = (static_cast<int>(study.models.size()) + columns - 1) / columns;
  const double width = left + columns * panel_width + (columns - 1) * gap_x + 24,
               height = top + rows * (panel_height + gap_y) - 20;
  Svg svg(width, height);
  svg.text({left, 32}, title, 16, Anchor::start, "#222222", true);
  draw_legend(svg, study);
  const auto [low, high] = range_of(study);
  for (int i = 0; i < static_cast<int>(study.models.size()); ++i) {
    const Frame frame{left + (panel_width + gap_x) * (i % columns),
                      top + (panel_height + gap_y) * (i / columns), low, high};
    draw_panel(svg, frame, study.models[static_cast<std::size_t>(i)], study, i % columns == 0);
    if (i / columns == rows - 1)
      svg.text({frame.x + panel_width / 2, frame.y + panel_height + 38}, "azimuth of the string [deg]", 13,
               Anchor::middle);
  }
  for (int row = 0; row < rows; ++row)
    svg.text({24, top + (panel_height + gap_y) * row + panel_height / 2}, "light / isotropic, scaled", 13,
             Anchor::middle, "#222222", false, true);
  return svg.str();
}

}  // namespace floe

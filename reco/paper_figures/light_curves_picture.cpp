#include "reco/paper_figures/light_curves_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reco/figures/map_marks.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

constexpr double panel_width = 400, panel_height = 340, left = 84, top = 128, gap = 40;
constexpr double unit_photons = 1e9;
constexpr double decades = 3;  // that the axis shows, at most
constexpr const char* grey = "#666666";
const std::array<Stroke, 5> strokes{Stroke{"#222222", 1.8, ""}, Stroke{"#e08e1b", 1.8, "7 3"},
                                    Stroke{"#3c8d40", 1.8, "2 3"}, Stroke{"#0b6fa4", 1.8, ""},
                                    Stroke{"#d1495b", 1.8, "9 3 2 3"}};

// [photoelectrons/ns] for N = 1e9.
double density(const LightCurves& curves, const CurvePanel& panel, double charge, std::size_t bin) {
  return charge * unit_photons / curves.photons / (panel.edges[bin + 1] - panel.edges[bin]);
}

struct Frame {
  double x, y;        // upper left corner
  double begin, end;  // [ns]
  double low, high;   // decimal logarithms
  Svg::Point at(double time, double value) const {
    const double share = value > 0 ? std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0) : 0;
    return {x + (time - begin) / (end - begin) * panel_width, y + panel_height * (1 - share)};
  }
};

// Whole decades below the highest bin of all panels, as far as there is light.
std::pair<double, double> range_of(const LightCurves& curves) {
  double highest = 0, lowest = 1e300;
  for (const CurvePanel& panel : curves.panels)
    for (const ArrivalCurve& curve : panel.curves)
      for (std::size_t bin = 0; bin < curve.charge.size(); ++bin) {
        const double value = density(curves, panel, curve.charge[bin], bin);
        highest = std::max(highest, value);
        if (value > 0) lowest = std::min(lowest, value);
      }
  if (!(highest > 0)) return {-1, 0};
  const double high = std::log10(1.3 * highest);
  return {std::max(std::floor(std::log10(lowest)), std::floor(high) - decades + 1), high};
}

void draw_axes(Svg& svg, const Frame& frame, bool first) {
  const Stroke strong{"#d5d5d5", 1, ""}, faint{"#eeeeee", 1, ""};
  for (double decade = frame.low; decade <= frame.high; ++decade)
    for (int k = 1; k < 10; ++k) {
      const double value = k * std::pow(10, decade);
      if (std::log10(value) > frame.high) break;
      svg.line(frame.at(frame.begin, value), frame.at(frame.end, value), k == 1 ? strong : faint);
      const auto [x, y] = frame.at(frame.begin, value);
      if (first && k == 1) svg.text({x - 7, y + 4}, fmt::format("{:g}", value), 12, Anchor::end, grey);
    }
  for (const double time : round_ticks(frame.begin, frame.end, 6)) {
    const auto [x, y] = frame.at(time, 0);
    svg.line({x, y}, {x, y + 4}, frame_stroke);
    svg.text({x, y + 18}, fmt::format("{:g}", time), 12, Anchor::middle, grey);
  }
}

// Steps, with gaps where a bin has less light than the axis shows: a logarithm has no zero.
void draw_curve(Svg& svg, const Frame& frame, const LightCurves& curves, const CurvePanel& panel,
                const ArrivalCurve& curve, const Stroke& stroke) {
  std::vector<Svg::Point> points;
  const auto finish = [&] {
    if (!points.empty()) svg.polyline(points, stroke);
    points.clear();
  };
  for (std::size_t bin = 0; bin < curve.charge.size(); ++bin) {
    const double value = density(curves, panel, curve.charge[bin], bin);
    if (!(value > 0 && std::log10(value) > frame.low)) {
      finish();
      continue;
    }
    points.push_back(frame.at(panel.edges[bin], value));
    points.push_back(frame.at(panel.edges[bin + 1], value));
  }
  finish();
}

void draw_legend(Svg& svg, const LightCurves& curves) {
  for (std::size_t m = 0; m < curves.models.size(); ++m) {
    const double x = left + 290 * static_cast<double>(m % 3), y = 56 + 22 * static_cast<double>(m / 3);
    svg.line({x, y}, {x + 34, y}, strokes[m % strokes.size()]);
    svg.text({x + 42, y + 4}, curves.models[m], 12.5);
  }
}

}  // namespace

std::string light_curves_csv(const LightCurves& curves) {
  std::string text = "string,model,time_begin_ns,time_end_ns,charge_per_ns,error\n";
  for (const CurvePanel& panel : curves.panels)
    for (std::size_t m = 0; m < curves.models.size(); ++m)
      for (std::size_t bin = 0; bin < panel.curves[m].charge.size(); ++bin)
        text += fmt::format("{},{},{:g},{:g},{:.5g},{:.3g}\n", panel.key, curves.models[m], panel.edges[bin],
                            panel.edges[bin + 1], density(curves, panel, panel.curves[m].charge[bin], bin),
                            density(curves, panel, std::sqrt(panel.curves[m].variance[bin]), bin));
  return text;
}

std::string light_curves_picture(const LightCurves& curves, const std::string& title) {
  const auto count = static_cast<double>(curves.panels.size());
  Svg svg(left + count * panel_width + (count - 1) * gap + 24, top + panel_height + 54);
  svg.text({left, 30}, title, 16, Anchor::start, "#222222", true);
  draw_legend(svg, curves);
  const auto [low, high] = range_of(curves);
  double x = left;
  for (const CurvePanel& panel : curves.panels) {
    const Frame frame{x, top, panel.edges.front(), panel.edges.back(), low, high};
    draw_axes(svg, frame, x == left);
    for (std::size_t m = 0; m < panel.curves.size(); ++m)
      draw_curve(svg, frame, curves, panel, panel.curves[m], strokes[m % strokes.size()]);
    draw_frame(svg, {x, top}, panel_width, panel_height);
    svg.text({x, top - 10}, panel.title, 13, Anchor::start, "#222222", true);
    svg.text({x + panel_width / 2, top + panel_height + 38}, "time after the flash [ns]", 13, Anchor::middle);
    x += panel_width + gap;
  }
  svg.text({26, top + panel_height / 2}, "charge per time, 1e9 photons [pe/ns]", 13, Anchor::middle,
           "#222222", false, true);
  return svg.str();
}

}  // namespace floe

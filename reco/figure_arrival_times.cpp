#include "reco/figure_arrival_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "data/base/error.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

constexpr double panel_width = 320, panel_height = 220, left_margin = 30, top_margin = 74, bottom_margin = 34;
constexpr int columns = 3;
constexpr const char* grey = "#666666";
const Stroke line_styles[] = {{"#0b6fa4", 2, ""}, {"#d1495b", 2, "6 3"}, {"#3c8d40", 2, "2 3"}};

// The bins of a panel: a window of times that holds nearly all light, in about `wanted` bins.
struct Window {
  std::size_t first, last;  // bins of ArrivalTimes, last excluded
  std::size_t group;        // bins joined to one
};

Window window_of(const ArrivalTimes& times) {
  constexpr std::size_t wanted = 45;
  const auto& measured = times.measured;
  const double total = std::accumulate(measured.begin(), measured.end(), 0.0);
  std::size_t first = 0, last = 0;
  double sum = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (sum <= 0.002 * total) first = i;
    sum += measured[i];
    if (sum <= 0.97 * total) last = i + 1;
  }
  const std::size_t margin = (last > first ? last - first : 1) / 12 + 1;
  first = first > margin ? first - margin : 0;
  last = std::min(measured.size(), last + margin);
  return {first, last, std::max<std::size_t>(1, (last - first) / wanted)};
}

std::vector<double> grouped(const std::vector<double>& bins, const Window& window) {
  std::vector<double> result;
  for (std::size_t i = window.first; i + window.group <= window.last; i += window.group)
    result.push_back(std::accumulate(bins.begin() + i, bins.begin() + i + window.group, 0.0));
  return result;
}

// A panel's axes: from time and charge to pixels.
struct Panel {
  double x, y;           // of the plot's lower left corner
  double width, height;  // of the plot
  double begin, end, top;

  Svg::Point at(double time, double charge) const {
    return {x + (time - begin) / (end - begin) * width, y - std::min(charge, top) / top * height};
  }
};

void draw_axes(Svg& svg, const Panel& panel, double bin_width) {
  const Stroke faint{"#dddddd", 0.7, ""}, axis{"#444444", 1, ""};
  for (const double charge : round_ticks(0, panel.top, 4)) {
    svg.line(panel.at(panel.begin, charge), panel.at(panel.end, charge), faint);
    const auto [x, y] = panel.at(panel.begin, charge);
    svg.text({x - 4, y + 3.5}, fmt::format("{:g}", charge), 10, Anchor::end, grey);
  }
  for (const double time : round_ticks(panel.begin, panel.end, 5)) {
    const auto [x, y] = panel.at(time, 0);
    svg.line({x, y}, {x, y + 4}, axis);
    svg.text({x, y + 15}, fmt::format("{:g}", time), 10, Anchor::middle, grey);
  }
  svg.line(panel.at(panel.begin, 0), panel.at(panel.end, 0), axis);
  svg.line(panel.at(panel.begin, 0), panel.at(panel.begin, panel.top), axis);
  svg.text({panel.x + panel.width / 2, panel.y + 29}, "time [ns]", 10.5, Anchor::middle, grey);
  svg.text({panel.x - 34, panel.y - panel.height / 2}, fmt::format("charge per {:g} ns [pe]", bin_width),
           10.5, Anchor::middle, grey, false, true);
}

std::vector<Svg::Point> steps(const Panel& panel, const std::vector<double>& bins, double bin_width) {
  std::vector<Svg::Point> points;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double begin = panel.begin + static_cast<double>(i) * bin_width;
    points.push_back(panel.at(begin, bins[i]));
    points.push_back(panel.at(begin + bin_width, bins[i]));
  }
  return points;
}

void draw_data(Svg& svg, const Panel& panel, const std::vector<double>& bins, double bin_width) {
  auto outline = steps(panel, bins, bin_width);
  outline.insert(outline.begin(), panel.at(panel.begin, 0));
  outline.push_back(panel.at(panel.begin + static_cast<double>(bins.size()) * bin_width, 0));
  svg.area(outline, "#9aa7b1", 0.35);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i] <= 0) continue;
    const double time = panel.begin + (static_cast<double>(i) + 0.5) * bin_width, error = std::sqrt(bins[i]);
    svg.line(panel.at(time, std::max(0.0, bins[i] - error)), panel.at(time, bins[i] + error),
             {"#333333", 1, ""});
    svg.circle(panel.at(time, bins[i]), 1.8, "#333333");
  }
}

// The fit's expectation for the same module, if it has one.
const ArrivalTimes* times_of(const CascadeFit& fit, ModuleId module) {
  const auto found = std::find_if(fit.arrival_times.begin(), fit.arrival_times.end(),
                                  [&](const ArrivalTimes& times) { return times.module == module; });
  return found == fit.arrival_times.end() ? nullptr : &*found;
}

// Expectations may have other bins than the panel: each bin's light is put where its middle lies.
std::vector<double> expected_in(const ArrivalTimes& times, const Panel& panel, double bin_width,
                                std::size_t count) {
  std::vector<double> result(count);
  for (std::size_t i = 0; i < times.expected.size(); ++i) {
    const double time = times.begin + (static_cast<double>(i) + 0.5) * times.step;
    const double place = (time - panel.begin) / bin_width;
    if (place >= 0 && place < static_cast<double>(count))
      result[static_cast<std::size_t>(place)] += times.expected[i];
  }
  return result;
}

void draw_panel(Svg& svg, Svg::Point corner, const ArrivalTimes& data, std::span<const FigureFit> fits) {
  const Window window = window_of(data);
  const std::vector<double> measured = grouped(data.measured, window);
  if (measured.empty()) return;
  const double bin_width = static_cast<double>(window.group) * data.step;
  Panel panel{
      corner.first + 44, corner.second + panel_height - 52, panel_width - 62, panel_height - 84, 0, 0, 1};
  panel.begin = data.begin + static_cast<double>(window.first) * data.step;
  panel.end = panel.begin + static_cast<double>(measured.size()) * bin_width;

  std::vector<std::vector<double>> expected;
  for (const FigureFit& fit : fits)
    if (const ArrivalTimes* times = times_of(*fit.fit, data.module))
      expected.push_back(expected_in(*times, panel, bin_width, measured.size()));
    else
      expected.emplace_back();
  double highest = *std::max_element(measured.begin(), measured.end());
  highest += std::sqrt(highest);
  for (const auto& bins : expected)
    if (!bins.empty()) highest = std::max(highest, *std::max_element(bins.begin(), bins.end()));
  panel.top = 1.08 * std::max(highest, 1.0);

  draw_axes(svg, panel, bin_width);
  draw_data(svg, panel, measured, bin_width);
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (!expected[i].empty())
      svg.polyline(steps(panel, expected[i], bin_width), line_styles[i % std::size(line_styles)]);
  svg.text({corner.first + 44, corner.second + 18},
           fmt::format("string {}, DOM {}", data.module.string, data.module.dom), 12, Anchor::start,
           "#222222", true);
  svg.text({corner.first + panel_width - 18, corner.second + 18},
           fmt::format("{:.{}f} pe", data.measured_charge, data.measured_charge < 100 ? 1 : 0), 11,
           Anchor::end, grey);
}

void draw_legend(Svg& svg, double y, std::span<const FigureFit> fits) {
  double x = left_margin + 14;
  const auto entry = [&](const std::string& words) {
    svg.text({x + 34, y + 4}, words, 12);
    x += 62 + 6.7 * static_cast<double>(words.size());
  };
  svg.rectangle({x, y - 6}, 26, 12, "#dde2e5");
  svg.circle({x + 13, y}, 1.8, "#333333");
  entry("data");
  for (std::size_t i = 0; i < fits.size(); ++i) {
    svg.line({x, y}, {x + 26, y}, line_styles[i % std::size(line_styles)]);
    entry(fits[i].label);
  }
}

}  // namespace

std::string figure_arrival_times(std::span<const FigureFit> fits, const std::string& title, int modules) {
  if (fits.empty()) throw UsageError("a picture of arrival times needs at least one fit");
  const std::vector<ArrivalTimes>& data = fits.front().fit->arrival_times;
  if (data.empty() || modules < 1)
    throw UsageError("there are no arrival times to draw: the fit saw no light");
  const int panels = std::min<int>(modules, static_cast<int>(data.size()));
  const int rows = (panels + columns - 1) / columns;

  Svg svg(2 * left_margin + columns * panel_width, top_margin + rows * panel_height + bottom_margin - 20);
  svg.text({left_margin + 14, 30}, title, 16, Anchor::start, "#222222", true);
  draw_legend(svg, 54, fits);
  for (int i = 0; i < panels; ++i)
    draw_panel(svg, {left_margin + panel_width * (i % columns), top_margin + panel_height * (i / columns)},
               data[static_cast<std::size_t>(i)], fits);
  return svg.str();
}

}  // namespace floe

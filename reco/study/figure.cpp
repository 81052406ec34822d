#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reco/figures/svg.h"
#include "reco/study/summary.h"

namespace floe {
namespace {

constexpr double panel = 260, gap = 70, top = 70;
constexpr double pull_range = 4;
constexpr std::size_t pull_bins = 16;
constexpr const char* grey = "#666666";
constexpr const char* blue = "#0b6fa4";
constexpr const char* red = "#d1495b";

struct Points {
  std::vector<double> pulls;
  std::vector<Svg::Point> position, direction;  // what the bound allows, what the fit missed by
};

Points collect(std::span<const StudyRow> rows) {
  Points points;
  for (const StudyRow& row : rows) {
    if (!is_fitted(row.fit)) continue;
    const StudyResiduals r = residuals_of(row, row.fit);
    const Vector7 pulls = r.pulls();
    points.pulls.insert(points.pulls.end(), pulls.begin(), pulls.end());
    if (!row.bound.allFinite()) continue;
    points.position.emplace_back(std::sqrt(r.bound.topLeftCorner<3, 3>().trace()),
                                 r.difference.head<3>().norm());
    points.direction.emplace_back(std::sqrt(r.bound.block<2, 2>(4, 4).trace()) / degree,
                                  r.difference.segment<2>(4).norm() / degree);
  }
  return points;
}

void draw_pulls(Svg& svg, double x, const std::vector<double>& pulls) {
  std::array<double, pull_bins> counts{};
  for (const double pull : pulls) {
    const double place = (pull + pull_range) / (2 * pull_range) * double(pull_bins);
    counts[static_cast<std::size_t>(std::clamp(place, 0.0, double(pull_bins) - 1))] += 1;
  }
  const double width = 2 * pull_range / double(pull_bins), n = double(pulls.size());
  const double highest =
      std::max(1.0, 1.15 * std::max(*std::max_element(counts.begin(), counts.end()), 0.4 * n * width));
  const auto at = [&](double pull, double count) -> Svg::Point {
    return {x + (pull + pull_range) / (2 * pull_range) * panel, top + panel * (1 - count / highest)};
  };
  for (std::size_t i = 0; i < pull_bins; ++i) {
    const auto corner = at(-pull_range + width * double(i), counts[i]);
    svg.rectangle(corner, panel / double(pull_bins) - 1, top + panel - corner.second, "#bcd4e2");
  }
  std::vector<Svg::Point> gauss;
  for (double pull = -pull_range; pull <= pull_range; pull += 0.1)
    gauss.push_back(at(pull, n * width * std::exp(-0.5 * pull * pull) / std::sqrt(2 * pi)));
  svg.polyline(gauss, {red, 2, ""});
  svg.line(at(-pull_range, 0), at(pull_range, 0), {grey, 1, ""});
  for (int pull = -4; pull <= 4; pull += 2)
    svg.text({at(pull, 0).first, top + panel + 16}, fmt::format("{}", pull), 11, Anchor::middle, grey);
  svg.text({x + panel / 2, top + panel + 34}, "(fit - truth) / error, all seven parameters", 12,
           Anchor::middle);
}

void draw_errors(Svg& svg, double x, const std::vector<Svg::Point>& points, const std::string& what,
                 const std::string& unit) {
  double low = 1e9, high = 1e-9;
  for (const auto& [bound, error] : points)
    for (const double value : {bound, error}) low = std::min(low, value), high = std::max(high, value);
  low = std::pow(10, std::floor(std::log10(std::max(low, 1e-6))));
  high = std::max(std::pow(10, std::ceil(std::log10(high))), 10 * low);
  const auto place = [&](double value) {
    return std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0) * panel;
  };
  for (double tick = low; tick <= 1.001 * high; tick *= 10) {
    const double p = place(tick);
    svg.line({x + p, top}, {x + p, top + panel}, {"#dddddd", 1, ""});
    svg.line({x, top + panel - p}, {x + panel, top + panel - p}, {"#dddddd", 1, ""});
    svg.text({x + p, top + panel + 16}, fmt::format("{:g}", tick), 11, Anchor::middle, grey);
    svg.text({x - 6, top + panel - p + 4}, fmt::format("{:g}", tick), 11, Anchor::end, grey);
  }
  svg.line({x, top + panel}, {x + panel, top}, {red, 2, ""});
  for (const auto& [bound, error] : points)
    svg.circle({x + place(bound), top + panel - place(error)}, 3, blue);
  svg.text({x + panel / 2, top + panel + 34}, fmt::format("Cramer-Rao bound of {} (rms) [{}]", what, unit),
           12, Anchor::middle);
  svg.text({x - 44, top + panel / 2}, fmt::format("{} from the truth [{}]", what, unit), 12, Anchor::middle,
           "#222222", false, true);
}

}  // namespace

std::string figure_of_study(std::span<const StudyRow> rows, const std::string& title) {
  Svg svg(3 * panel + 4 * gap, top + panel + 60);
  const Points points = collect(rows);
  svg.text({gap, 30}, title, 16, Anchor::start, "#222222", true);
  svg.text({gap, 50}, "Line: a Gaussian of width 1 (left); errors as large as the bound (middle, right)", 12,
           Anchor::start, grey);
  if (points.pulls.empty()) return svg.str();
  draw_pulls(svg, gap, points.pulls);
  draw_errors(svg, panel + 2 * gap, points.position, "position", "m");
  draw_errors(svg, 2 * panel + 3 * gap, points.direction, "direction", "deg");
  return svg.str();
}

}  // namespace floe

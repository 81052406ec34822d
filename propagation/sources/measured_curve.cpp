#include "propagation/sources/measured_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/text.h"
#include "data/base/vec3.h"

namespace floe {

namespace {

// Throws unless the table can be a curve; `where` is said for each point, with `at` in units of `unit`.
template <typename Where>
void expect_curve(const std::vector<MeasuredCurve::Point>& points, const Location& whole, double unit,
                  Where where) {
  bool light = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [at, intensity] = points[i];
    if (!std::isfinite(at) || !std::isfinite(intensity) || intensity < 0)
      throw InputError(where(i), fmt::format("intensity {:g} at {:g}", intensity, at / unit),
                       "finite numbers, the intensity not below 0");
    if (i > 0 && !(at > points[i - 1].at))
      throw InputError(where(i), fmt::format("{:g} after {:g}", at / unit, points[i - 1].at / unit),
                       "a first column that rises from line to line");
    light = light || intensity > 0;
  }
  if (points.size() < 2 || !light)
    throw InputError(whole, fmt::format("{} points, {} light", points.size(), light ? "with" : "without"),
                     "at least two points, and an intensity above 0");
}

MeasuredCurve read_curve(const std::filesystem::path& file, const char* first, double low, double high,
                         double unit) {
  const auto lines = read_text_lines(file);
  std::vector<MeasuredCurve::Point> points;
  for (const TextLine& line : lines) {
    expect_fields(line, 2, 2, fmt::format("{} and relative intensity", first));
    const double at = parse_number(line, 0, first);
    expect_range(line, at, low, high, first);
    points.push_back({at * unit, parse_number(line, 1, "relative intensity")});
  }
  expect_curve(points, {file.string()}, unit, [&](std::size_t i) { return lines[i].where; });
  return MeasuredCurve(std::move(points));
}

// Mean of `value` over the curve times `weight`, by the midpoint rule.
template <typename Weight, typename Value>
double mean(const MeasuredCurve& curve, double high, Weight weight, Value value) {
  constexpr int steps = 20000;
  const double step = (high - curve.low()) / steps;
  double sum = 0, norm = 0;
  for (int i = 0; i < steps; ++i) {
    const double at = curve.low() + (i + 0.5) * step, share = curve(at) * weight(at);
    sum += share * value(at);
    norm += share;
  }
  return sum / norm;
}

// The table's outermost steps are drawn evenly, so that they must not reach to where there is next to no
// light: what lies beyond a millionth of it on either side is left out.
template <typename Density>
QuantileTable table_of(double low, double high, Density density) {
  constexpr int steps = 20000;
  constexpr double negligible = 1e-6;
  const double step = (high - low) / steps;
  std::vector<double> light(steps);
  double all = 0;
  for (int i = 0; i < steps; ++i) all += light[static_cast<std::size_t>(i)] = density(low + (i + 0.5) * step);
  std::size_t first = 0, end = steps;
  for (double below = light[first]; below < negligible * all; below += light[++first]) {
  }
  for (double above = light[end - 1]; above < negligible * all; above += light[--end - 1]) {
  }
  return QuantileTable::of_density(low + static_cast<double>(first) * step,
                                   low + static_cast<double>(end) * step, density);
}

double end_of_beam(const MeasuredCurve& beam) {
  return std::min(beam.high(), pi);
}

}  // namespace

MeasuredCurve::MeasuredCurve(std::vector<Point> points) : points_(std::move(points)) {
  expect_curve(points_, {"measured curve"}, 1, [](std::size_t) { return Location{"measured curve"}; });
}

double MeasuredCurve::operator()(double at) const {
  if (at < low() || at > high()) return 0;
  const auto above = std::upper_bound(points_.begin() + 1, points_.end() - 1, at,
                                      [](double value, const Point& point) { return value < point.at; });
  const Point &a = *(above - 1), &b = *above;
  return a.intensity + (at - a.at) / (b.at - a.at) * (b.intensity - a.intensity);
}

MeasuredCurve MeasuredCurve::stretched(double factor) const {
  std::vector<Point> points = points_;
  for (Point& point : points) point.at *= factor;
  return MeasuredCurve(std::move(points));
}

MeasuredCurve read_beam_profile(const std::filesystem::path& file) {
  return read_curve(file, "angle [deg]", 0, 180, degree);
}

MeasuredCurve read_pulse_shape(const std::filesystem::path& file) {
  return read_curve(file, "time [ns]", -1e6, 1e6, 1);
}

QuantileTable beam_angles(const MeasuredCurve& beam) {
  return table_of(beam.low(), end_of_beam(beam), [&](double angle) { return beam(angle) * std::sin(angle); });
}

QuantileTable pulse_times(const MeasuredCurve& pulse) {
  return table_of(pulse.low(), pulse.high(), pulse);
}

double equivalent_beam_width(const MeasuredCurve& beam) {
  const double loss = mean(
      beam, end_of_beam(beam), [](double angle) { return std::sin(angle); },
      [](double angle) { return 1 - std::cos(angle); });
  // von Mises-Fisher of concentration 1/width^2: <1 - cos> = width^2, but for narrow beams only terms of
  // exp(-2/width^2).
  return std::min(std::sqrt(loss), pi / 2);
}

double equivalent_pulse_width(const MeasuredCurve& pulse) {
  const auto even = [](double) { return 1.0; };
  const double centre = mean(pulse, pulse.high(), even, [](double time) { return time; });
  const double variance =
      mean(pulse, pulse.high(), even, [&](double time) { return (time - centre) * (time - centre); });
  return std::sqrt(12 * variance);
}

}  // namespace floe

#include "propagation/crystal/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/error.h"

namespace floe {

namespace {

constexpr std::size_t portions = 20;
constexpr double core_limit = 3;  // core widths

using Numbers = std::array<double, pattern_numbers>;

// Deflections and displacements along one axis.
struct Axis {
  std::vector<double> deflection, shift;
};

// q in (0, 1), linear between the ordered values.
double quantile(const std::vector<double>& ordered, double q) {
  const double place = q * static_cast<double>(ordered.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ordered.size() - 1);
  return ordered[below] + (place - static_cast<double>(below)) * (ordered[above] - ordered[below]);
}

struct Quantiles {
  double low, median, high;
  double width() const { return (high - low) / 2; }
  bool holds(double value) const { return std::abs(value - median) <= core_limit * width(); }
};
Quantiles quantiles_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  constexpr double one_sigma = 0.15865525393145707;  // of a Gaussian, below its mean less its width
  return {quantile(values, one_sigma), quantile(values, 0.5), quantile(values, 1 - one_sigma)};
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double moment(const std::vector<double>& values, double mean, int power) {
  double sum = 0;
  for (const double value : values) sum += std::pow(value - mean, power);
  return sum / static_cast<double>(values.size());
}

double covariance(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size());
}

double ratio(double a, double b) {
  return b == 0 ? 0 : a / b;
}

// Displacement against deflection: slope and residual variance, in units of what Brownian motion of the
// direction gives (mean delta L/2, variance sigma^2 L^2/12).
struct ShiftLaw {
  double slope, variance;
};
ShiftLaw shift_law(const Axis& axis, double length) {
  const double variance = covariance(axis.deflection, axis.deflection),
               common = covariance(axis.deflection, axis.shift);
  const double left = covariance(axis.shift, axis.shift) - ratio(common * common, variance);
  return {ratio(common, variance * length / 2), ratio(left, variance * length * length / 12)};
}

Numbers numbers_of(const Axis& x, const Axis& y, double backward, double length) {
  const Quantiles qx = quantiles_of(x.deflection), qy = quantiles_of(y.deflection);
  Axis core_x, core_y;
  for (std::size_t i = 0; i < x.deflection.size(); ++i) {
    if (!qx.holds(x.deflection[i]) || !qy.holds(y.deflection[i])) continue;
    core_x.deflection.push_back(x.deflection[i]), core_x.shift.push_back(x.shift[i]);
    core_y.deflection.push_back(y.deflection[i]), core_y.shift.push_back(y.shift[i]);
  }
  Numbers numbers{};
  const auto set = [&](PatternNumber number, double value) {
    numbers[static_cast<std::size_t>(number)] = value;
  };
  using enum PatternNumber;
  const double mean_x_of_all = mean_of(x.deflection), mean_y_of_all = mean_of(y.deflection);
  const double square_x = moment(x.deflection, mean_x_of_all, 2),
               square_y = moment(y.deflection, mean_y_of_all, 2);
  set(mean_x, mean_x_of_all), set(mean_y, mean_y_of_all);
  set(core_mean_x, mean_of(core_x.deflection)), set(core_mean_y, mean_of(core_y.deflection));
  set(median_x, qx.median);
  set(sigma_x, std::sqrt(square_x)), set(sigma_y, std::sqrt(square_y));
  set(core_sigma_x, qx.width()), set(core_sigma_y, qy.width());
  set(skewness_x, ratio(moment(x.deflection, mean_x_of_all, 3), std::pow(square_x, 1.5)));
  set(core_skewness_x, ratio(qx.high + qx.low - 2 * qx.median, 2 * qx.width()));
  set(kurtosis_x, ratio(moment(x.deflection, mean_x_of_all, 4), square_x * square_x) - 3);
  set(kurtosis_y, ratio(moment(y.deflection, mean_y_of_all, 4), square_y * square_y) - 3);
  set(tail_share,
      1 - ratio(static_cast<double>(core_x.deflection.size()), static_cast<double>(x.deflection.size())));
  set(backward_share, backward);
  set(correlation_xy, ratio(covariance(core_x.deflection, core_y.deflection),
                            std::sqrt(covariance(core_x.deflection, core_x.deflection) *
                                      covariance(core_y.deflection, core_y.deflection))));
  set(shift_x, mean_of(x.shift) / length), set(shift_y, mean_of(y.shift) / length);
  const ShiftLaw law_x = shift_law(core_x, length), law_y = shift_law(core_y, length);
  set(shift_slope_x, law_x.slope), set(shift_slope_y, law_y.slope);
  set(shift_variance_x, law_x.variance), set(shift_variance_y, law_y.variance);
  return numbers;
}

Numbers numbers_of(std::span<const WalkedPhoton> photons, double length) {
  Axis x, y;
  double backward = 0;
  for (const WalkedPhoton& photon : photons) {
    const Vec3& n = photon.direction;
    const double across = n.head<2>().norm();
    const double scale = across > 0 ? std::atan2(across, n.z()) / across : 1;
    x.deflection.push_back(scale * n.x()), x.shift.push_back(photon.position.x());
    y.deflection.push_back(scale * n.y()), y.shift.push_back(photon.position.y());
    if (n.z() < 0) ++backward;
  }
  return numbers_of(x, y, backward / static_cast<double>(photons.size()), length);
}

}  // namespace

std::string_view name_of(PatternNumber number) {
  constexpr std::array<std::string_view, pattern_numbers> names{
      "mean_x",           "mean_y",          "core_mean_x",  "core_mean_y",   "median_x",
      "sigma_x",          "sigma_y",         "core_sigma_x", "core_sigma_y",  "skewness_x",
      "core_skewness_x",  "kurtosis_x",      "kurtosis_y",   "tail_share",    "backward_share",
      "correlation_xy",   "shift_x",         "shift_y",      "shift_slope_x", "shift_slope_y",
      "shift_variance_x", "shift_variance_y"};
  return names[static_cast<std::size_t>(number)];
}

PatternStatistics::PatternStatistics(std::span<const WalkedPhoton> photons, double length) {
  if (photons.size() < fewest_pattern_photons)
    throw UsageError(fmt::format("a diffusion pattern of {} photons; expected {} or more", photons.size(),
                                 fewest_pattern_photons));
  const Numbers whole = numbers_of(photons, length);
  Numbers sum{}, squares{};
  for (std::size_t i = 0; i < portions; ++i) {
    const std::size_t first = i * photons.size() / portions, end = (i + 1) * photons.size() / portions;
    const Numbers part = numbers_of(photons.subspan(first, end - first), length);
    for (std::size_t k = 0; k < pattern_numbers; ++k) {
      sum[k] += part[k] - whole[k];
      squares[k] += (part[k] - whole[k]) * (part[k] - whole[k]);
    }
  }
  constexpr double n = portions;
  for (std::size_t k = 0; k < pattern_numbers; ++k) {
    const double variance = (squares[k] - sum[k] * sum[k] / n) / (n - 1);
    estimates_[k] = {whole[k], std::sqrt(std::max(0.0, variance) / n)};
  }
}

}  // namespace floe

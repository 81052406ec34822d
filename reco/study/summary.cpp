#include "reco/study/summary.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "reco/study/drawn_median.h"

namespace floe {
namespace {

constexpr double share = 0.6827;
constexpr double two_dimensions = 2.2958, three_dimensions = 3.5267;  // chi-square of `share`

// Half of the interval between the quantiles that leave out as many values on either side as of a Gaussian
// beyond one standard deviation.
double half_of_central_share(std::vector<double> values) {
  if (values.size() < 2) return StudyLine::unknown;
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double part) {
    const double place = part * double(values.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), values.size() - 2);
    return values[below] + (place - double(below)) * (values[below + 1] - values[below]);
  };
  return 0.5 * (quantile(0.5 + 0.5 * share) - quantile(0.5 - 0.5 * share));
}

class LineBuilder {
 public:
  LineBuilder(const std::string& name, const std::string& unit, double scale) : scale_(scale) {
    line_.name = name;
    line_.unit = unit;
  }
  void add_signed(double difference, double error) {
    differences_.push_back(scale_ * difference);
    add_pull(difference / error);
  }
  void add_pull(double pull) {
    pulls_.push_back(pull);
    inside_ += std::abs(pull) < 1;
  }
  void add_length(double length, bool inside) {
    lengths_.push_back(scale_ * length);
    inside_ += inside;
  }
  void add_bound(const Eigen::MatrixXd& covariance) { bounds_.push_back(scale_ * scale_ * covariance); }
  void add_absolute(double value) { lengths_.push_back(scale_ * value); }

  StudyLine line() const {
    StudyLine result = line_;
    const std::size_t n = std::max(pulls_.size(), lengths_.size());
    result.count = n;
    if (n == 0) return result;
    const auto moments = [](const std::vector<double>& values, double& mean, double& spread) {
      if (values.empty()) return;
      mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
      double square = 0;
      for (const double value : values) square += (value - mean) * (value - mean);
      spread = values.size() > 1 ? std::sqrt(square / double(values.size() - 1)) : StudyLine::unknown;
    };
    double spread = StudyLine::unknown;
    moments(differences_, result.bias, spread);
    result.bias_error = spread / std::sqrt(double(n));
    moments(pulls_, result.pull_mean, result.pull_width);
    result.pull_width_error = result.pull_width / std::sqrt(2.0 * double(n));
    result.pull_core = half_of_central_share(pulls_);
    result.pull_core_error = 0.96 * result.pull_core / std::sqrt(double(n));  // of a Gaussian's quantiles
    result.median_error = median(lengths_);
    const DrawnMedian at_bound = median_of_gaussian_lengths(bounds_);
    result.median_bound = at_bound.value;
    result.median_scatter = at_bound.scatter;
    result.coverage = double(inside_) / double(n);
    result.coverage_error = std::sqrt(share * (1 - share) / double(n));
    return result;
  }

 private:
  StudyLine line_;
  double scale_;
  std::vector<double> differences_, pulls_, lengths_;
  std::vector<Eigen::MatrixXd> bounds_;
  std::size_t inside_ = 0;
};

}  // namespace

bool is_fitted(const StudyFit& fit) {
  return is_usable(fit.status) && fit.covariance.allFinite();
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

StudyResiduals residuals_of(const StudyRow& row, const StudyFit& fit) {
  StudyResiduals result;
  Vector7 unit = Vector7::Ones();
  unit(5) = std::sin(fit.cascade.zenith);
  unit(6) = 1 / fit.cascade.energy;
  result.covariance = unit.asDiagonal() * fit.covariance * unit.asDiagonal();
  unit(6) = 1 / row.truth.energy;
  result.difference = -displacement(fit.cascade, row.truth).cwiseProduct(unit);
  unit(5) = std::sin(row.truth.zenith);
  result.bound = unit.asDiagonal() * row.bound * unit.asDiagonal();
  return result;
}

StudyTable summarise(std::span<const StudyRow> rows, const std::string& title) {
  std::vector<LineBuilder> lines;
  for (const ShownParameter& shown : shown_parameters)
    lines.emplace_back(shown.name, shown.unit, 1 / shown.unit_size);
  lines.back() = {"energy", "%", 100};  // relative
  LineBuilder position("position", "m", 1), direction("direction", "deg", 1 / degree),
      pooled("pooled", "", 1);
  StudyTable table;
  table.title = title;
  table.events = rows.size();
  for (const StudyRow& row : rows) {
    if (!is_fitted(row.fit)) {
      table.failures.push_back(fmt::format("{:g} GeV event {}: {}: {}", row.energy, row.index,
                                           name_of(row.fit.status), row.fit.reason));
      continue;
    }
    ++table.fitted;
    if (row.fit.other_minimum) ++table.contested;
    const StudyResiduals r = residuals_of(row, row.fit);
    for (int i = 0; i < 7; ++i) {
      LineBuilder& line = lines[static_cast<std::size_t>(i)];
      const double error = std::sqrt(r.covariance(i, i));
      line.add_signed(r.difference(i), error);
      line.add_absolute(std::abs(r.difference(i)));
      pooled.add_pull(r.difference(i) / error);
      if (row.bound.allFinite()) line.add_bound(r.bound.block<1, 1>(i, i));
    }
    const Eigen::Matrix3d c3 = r.covariance.topLeftCorner<3, 3>();
    const Eigen::Matrix2d c2 = r.covariance.block<2, 2>(4, 4);
    const Vec3 d3 = r.difference.head<3>();
    const Eigen::Vector2d d2 = r.difference.segment<2>(4);
    position.add_length(d3.norm(), d3.dot(c3.ldlt().solve(d3)) < three_dimensions);
    direction.add_length(d2.norm(), d2.dot(c2.ldlt().solve(d2)) < two_dimensions);
    if (row.bound.allFinite()) {
      position.add_bound(r.bound.topLeftCorner<3, 3>());
      direction.add_bound(r.bound.block<2, 2>(4, 4));
    }
  }
  for (const LineBuilder& line : lines) table.lines.push_back(line.line());
  for (const LineBuilder* line : {&position, &direction, &pooled}) table.lines.push_back(line->line());
  return table;
}

std::string text_of(const StudyTable& table) {
  std::string text = fmt::format("{}: {} of {} events fitted", table.title, table.fitted, table.events);
  text += table.contested > 0 ? fmt::format(", {} with a competing minimum\n", table.contested) : "\n";
  text += fmt::format("  {:<10} {:>4}  {:>17}  {:>8}  {:>8}  {:>12}  {:>6}  {:>13}  {:>14}  {:>13}\n", "", "",
                      "bias", "median", "bound", "ratio", "pull", "pull width", "of central 68%", "in 68%");
  for (const StudyLine& line : table.lines) {
    const bool pulls = line.pull_width > 0, errors = line.median_error > 0;
    text += fmt::format("  {:<10} {:>4}", line.name, line.unit);
    text += line.bias_error > 0 ? fmt::format("  {:>8.3f} +- {:<5.3f}", line.bias, line.bias_error)
                                : fmt::format("  {:>17}", "");
    text += errors ? fmt::format("  {:>8.3f}  {:>8.3f}  {:>4.2f} +- {:<4.2f}", line.median_error,
                                 line.median_bound, line.median_error / line.median_bound,
                                 line.median_scatter / line.median_bound)
                   : fmt::format("  {:>8}  {:>8}  {:>12}", "", "", "");
    text += pulls ? fmt::format("  {:>6.2f}  {:>5.2f} +- {:<4.2f}  {:>6.2f} +- {:<4.2f}", line.pull_mean,
                                line.pull_width, line.pull_width_error, line.pull_core, line.pull_core_error)
                  : fmt::format("  {:>6}  {:>13}  {:>14}", "", "", "");
    text += line.count > 0
                ? fmt::format("  {:>5.1f} +- {:<4.1f}\n", 100 * line.coverage, 100 * line.coverage_error)
                : "\n";
  }
  for (const std::string& failure : table.failures) text += "  not fitted: " + failure + "\n";
  return text;
}

}  // namespace floe

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

constexpr double two_dimensions = 2.2958, three_dimensions = 3.5267;  // chi-square of `central_share`

// One parameter, or a length, over all events.
class LineBuilder {
 public:
  LineBuilder(const std::string& name, const std::string& unit, double scale) : scale_(scale) {
    line_.name = name;
    line_.unit = unit;
  }
  void add_signed(double difference, double error) {
    differences_.push_back(scale_ * difference);
    lengths_.push_back(scale_ * std::abs(difference));
    pulls_.push_back(difference / error);
  }
  void add_length(double length, bool inside) {
    lengths_.push_back(scale_ * length);
    inside_ += inside;
  }
  void add_bound(const Eigen::MatrixXd& covariance) { bounds_.push_back(scale_ * scale_ * covariance); }

  StudyLine line() const {
    StudyLine result = line_;
    result.count = lengths_.size();
    const double n = double(result.count);
    if (n == 0) return result;
    if (!differences_.empty()) {
      result.bias = mean_of(differences_);
      result.bias_error = standard_deviation(differences_) / std::sqrt(n);
    }
    result.pull = summary_of(pulls_);
    if (pulls_.empty()) {
      result.pull.coverage = double(inside_) / n;
      result.pull.coverage_error = binomial_error(n);
    }
    result.median_error = median(lengths_);
    const DrawnMedian at_bound = median_of_gaussian_lengths(bounds_);
    result.median_bound = at_bound.value;
    result.median_scatter = at_bound.scatter;
    return result;
  }

 private:
  StudyLine line_;
  double scale_;
  std::vector<double> differences_, pulls_, lengths_;
  std::vector<Eigen::MatrixXd> bounds_;
  std::size_t inside_ = 0;
};

StudyLine pooled_line(const std::vector<Vector7>& pulls_of_events) {
  StudyLine line;
  line.name = "pooled";
  line.count = 7 * pulls_of_events.size();
  line.pull = summary_of(pulls_of_events);
  return line;
}

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
  LineBuilder position("position", "m", 1), direction("direction", "deg", 1 / degree);
  std::vector<Vector7> pulls;
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
    const bool bounded = row.bound.allFinite();
    for (int i = 0; i < 7; ++i) {
      LineBuilder& line = lines[static_cast<std::size_t>(i)];
      line.add_signed(r.difference(i), std::sqrt(r.covariance(i, i)));
      if (bounded) line.add_bound(r.bound.block<1, 1>(i, i));
    }
    pulls.push_back(r.pulls());
    const Eigen::Matrix3d c3 = r.covariance.topLeftCorner<3, 3>();
    const Eigen::Matrix2d c2 = r.covariance.block<2, 2>(4, 4);
    const Vec3 d3 = r.difference.head<3>();
    const Eigen::Vector2d d2 = r.difference.segment<2>(4);
    position.add_length(d3.norm(), d3.dot(c3.ldlt().solve(d3)) < three_dimensions);
    direction.add_length(d2.norm(), d2.dot(c2.ldlt().solve(d2)) < two_dimensions);
    if (bounded) position.add_bound(r.bound.topLeftCorner<3, 3>());
    if (bounded) direction.add_bound(r.bound.block<2, 2>(4, 4));
  }
  for (const LineBuilder& line : lines) table.lines.push_back(line.line());
  for (const LineBuilder* line : {&position, &direction}) table.lines.push_back(line->line());
  table.lines.push_back(pooled_line(pulls));
  return table;
}

std::string text_of(const StudyTable& table) {
  std::string text = fmt::format("{}: {} of {} events fitted", table.title, table.fitted, table.events);
  text += table.contested > 0 ? fmt::format(", {} with a competing minimum\n", table.contested) : "\n";
  text += fmt::format("  {:<10} {:>4}  {:>17}  {:>8}  {:>8}  {:>12}  {:>6}  {:>13}  {:>14}  {:>13}\n", "", "",
                      "bias", "median", "bound", "ratio", "pull", "pull width", "of central 68%", "in 68%");
  for (const StudyLine& line : table.lines) {
    const PullSummary& pull = line.pull;
    const bool errors = line.median_error > 0;
    text += fmt::format("  {:<10} {:>4}", line.name, line.unit);
    text += line.bias_error > 0 ? fmt::format("  {:>8.3f} +- {:<5.3f}", line.bias, line.bias_error)
                                : fmt::format("  {:>17}", "");
    text += errors ? fmt::format("  {:>8.3f}  {:>8.3f}  {:>4.2f} +- {:<4.2f}", line.median_error,
                                 line.median_bound, line.median_error / line.median_bound,
                                 line.median_scatter / line.median_bound)
                   : fmt::format("  {:>8}  {:>8}  {:>12}", "", "", "");
    text += pull.width > 0
                ? fmt::format("  {:>6.2f}  {:>5.2f} +- {:<4.2f}", pull.mean, pull.width, pull.width_error)
                : fmt::format("  {:>6}  {:>13}", "", "");
    text += pull.core > 0 ? fmt::format("  {:>6.2f} +- {:<4.2f}", pull.core, pull.core_error)
                          : fmt::format("  {:>14}", "");
    text += line.count > 0
                ? fmt::format("  {:>5.1f} +- {:<4.1f}\n", 100 * pull.coverage, 100 * pull.coverage_error)
                : "\n";
  }
  for (const std::string& failure : table.failures) text += "  not fitted: " + failure + "\n";
  return text;
}

}  // namespace floe

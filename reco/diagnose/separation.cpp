#include "reco/diagnose/separation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace floe {

namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr double clear = 3;         // standard deviations
constexpr double most_light = 1e3;  // of the data's: nobody flashes so often
constexpr double good_part = 0.5;   // of what tells them apart

// By bin: expected counts of the data, and the square of the relative difference, right on average.
struct DifferentLight {
  VectorXd expected, squared;
};

DifferentLight different_light(const Survey& survey, const VectorXd& difference) {
  VectorXd squared(survey.bins);
  for (const SurveyRun& run : survey.runs)
    squared.segment(run.first, run.bins.size()) =
        (run.halves[0] * difference).cwiseProduct(run.halves[1] * difference);
  return {expected_of(survey), std::move(squared)};
}

// Chi-square between the two, by bin, for data of so many times the light.
VectorXd apart(const Survey& survey, const DifferentLight& light, double times) {
  VectorXd squares(survey.bins);
  for (const SurveyRun& run : survey.runs) {
    const ArrayXd counts = times * light.expected.segment(run.first, run.bins.size()).array();
    const ArrayXd variance = run.data_dispersion * counts + (run.model_error * counts).square();
    squares.segment(run.first, run.bins.size()) =
        light.squared.segment(run.first, run.bins.size()).array() * counts.square() / variance.max(1e-12);
  }
  return squares;
}

double light_needed(const Survey& survey, const DifferentLight& light) {
  constexpr int halvings = 40;
  const auto is_enough = [&](double ln_times) {
    return apart(survey, light, std::exp(ln_times)).sum() >= clear * clear;
  };
  double low = -std::log(most_light), high = std::log(most_light);
  if (!is_enough(high)) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < halvings; ++i) (is_enough((low + high) / 2) ? high : low) = (low + high) / 2;
  return std::exp(high);
}

// Of all regions that hold a good part of what tells the two apart, the one with the least light.
struct TellingRegion {
  const Axis* axis = nullptr;
  CellRange range;
  double light = 1, told = 0;  // shares
};

TellingRegion telling_region(const std::vector<Axis>& axes, const VectorXd& expected,
                             const VectorXd& squares) {
  TellingRegion best;
  for (const Axis& axis : axes) {
    if (!axis.ordered) continue;
    const VectorXd light = axis.sums(expected) / expected.sum(), told = axis.sums(squares) / squares.sum();
    for (int first = 0; first < axis.size(); ++first) {
      double lit = 0, sum = 0;
      for (int cells = 1; cells < axis.size() && (axis.circular || first + cells <= axis.size()); ++cells) {
        const int cell = (first + cells - 1) % axis.size();
        lit += light(cell), sum += told(cell);
        if (sum >= good_part && lit < best.light) best = {&axis, {first, cells}, lit, sum};
      }
    }
  }
  return best;
}

// That tells the most for its light.
const SurveyRun& telling_run(const Survey& survey, const VectorXd& expected, const VectorXd& squares) {
  const auto worth = [&](const SurveyRun& run) {
    const double light = expected.segment(run.first, run.bins.size()).sum();
    return light > 0 ? squares.segment(run.first, run.bins.size()).sum() / light : 0;
  };
  return *std::max_element(survey.runs.begin(), survey.runs.end(),
                           [&](const SurveyRun& a, const SurveyRun& b) { return worth(a) < worth(b); });
}

std::string need_text(const Separation& s) {
  if (s.light > 1)
    return fmt::format("{:.1f} times this light would tell {} from {} (three standard deviations)", s.light,
                       s.effect, s.other);
  return fmt::format("These data should tell {} from {} ({:.1f} standard deviations) if both are fitted",
                     s.effect, s.other, clear / std::sqrt(s.light));
}

}  // namespace

Separation separation(const Survey& survey, const std::vector<Axis>& axes, const VectorXd& difference,
                      const std::string& effect, const std::string& other) {
  Separation result{effect, other, 0, "", ""};
  const DifferentLight light = different_light(survey, difference);
  result.light = light_needed(survey, light);
  if (!std::isfinite(result.light)) {
    result.sentence =
        fmt::format("No light of these flashers would tell {} from {}: it takes flashers in other places.",
                    effect, other);
    return result;
  }
  const VectorXd squares = apart(survey, light, result.light);
  result.run = telling_run(survey, light.expected, squares).name;
  const TellingRegion region = telling_region(axes, light.expected, squares);
  result.sentence = need_text(result) + fmt::format("; run {} tells the most for its light", result.run);
  if (region.axis)
    result.sentence += fmt::format(", and {:.0f}% of what tells them apart is {}, in {:.0f}% of the light",
                                   100 * std::min(1.0, region.told), place_text(*region.axis, region.range),
                                   100 * region.light);
  result.sentence += ".";
  return result;
}

}  // namespace floe

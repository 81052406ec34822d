#include "reco/diagnose/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "propagation/engine/threads.h"
#include "reco/diagnose/score_test.h"

namespace floe {

namespace {

using Eigen::VectorXd;

// By bin, or by cell of an axis.
struct Residuals {
  VectorXd off, variance, expected;
};

Residuals along(const Axis& axis, const Residuals& all) {
  return {axis.sums(all.off), axis.sums(all.variance), axis.sums(all.expected)};
}

VectorXd variance_of(const Survey& survey) {
  VectorXd variance(survey.bins);
  for (const SurveyRun& run : survey.runs)
    variance.segment(run.first, run.bins.size()) = run.data_dispersion * run.expected +
                                                   run.dispersion * run.scale * run.expected +
                                                   (run.model_error * run.expected).square();
  return variance;
}

struct Extreme : CellRange {
  double z = 0;
};

// Of all regions up to half of the axis. A few counts where hardly any light is expected are not Gaussian.
Extreme extreme(const AxisCells& axis, const Residuals& cells) {
  constexpr double least_light = 20;
  const int size = axis.size(), most = axis.ordered ? std::max(1, size / 2) : 1;
  Extreme best;
  for (int first = 0; first < size; ++first) {
    double off = 0, variance = 0, light = 0;
    for (int count = 1; count <= most; ++count) {
      int cell = first + count - 1;
      if (cell >= size && !axis.circular) break;
      cell %= size;
      off += cells.off(cell), variance += cells.variance(cell), light += cells.expected(cell);
      if (light < least_light) continue;
      const double z = off / std::sqrt(variance);
      if (std::abs(z) > std::abs(best.z)) best = {{first, count}, z};
    }
  }
  return best;
}

// By axis: what half the square of the extreme is in light of the model itself.
std::vector<std::vector<double>> drawn_extremes(const Survey& survey, const std::vector<Axis>& axes,
                                                const std::vector<Residuals>& cells, const Draws& draws) {
  constexpr std::uint64_t first_draw = std::uint64_t{1} << 32;
  std::vector<std::vector<double>> drawn(axes.size(),
                                         std::vector<double>(static_cast<std::size_t>(draws.count)));
#pragma omp parallel for schedule(dynamic) num_threads(thread_count(draws.threads))
  for (int d = 0; d < draws.count; ++d) {
    const auto draw = static_cast<std::size_t>(d);
    const VectorXd off = residual_of(survey, drawn_counts(survey, draws.seed, first_draw + draw));
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double z = extreme(axes[a], {axes[a].sums(off), cells[a].variance, cells[a].expected}).z;
      drawn[a][draw] = z * z / 2;
    }
  }
  return drawn;
}

ResidualProfile profile_of(const AxisCells& axis, const Residuals& cells) {
  ResidualProfile profile{axis, {}, {}};
  for (Eigen::Index i = 0; i < cells.off.size(); ++i) {
    const double light = cells.expected(i);
    profile.relative.push_back(light > 0 ? cells.off(i) / light : 0);
    profile.error.push_back(light > 0 ? std::sqrt(cells.variance(i)) / light : 0);
  }
  return profile;
}

Region region_of(const AxisCells& axis, const Extreme& at, const Residuals& cells, double significance) {
  const int size = axis.size();
  double off = 0, light = 0;
  for (int i = 0; i < at.cells; ++i) {
    off += cells.off((at.first + i) % size);
    light += cells.expected((at.first + i) % size);
  }
  Region region;
  region.axis = axis.axis;
  region.from = axis.low[static_cast<std::size_t>(at.first)];
  region.to = axis.high[static_cast<std::size_t>((at.first + at.cells - 1) % size)];
  if (!axis.names.empty()) region.name = axis.names[static_cast<std::size_t>(at.first)];
  region.sign = at.z < 0 ? -1 : 1;
  region.relative = light > 0 ? off / light : 0;
  region.significance = significance;
  region.sentence =
      fmt::format("The data have {:.1f}% {} light than the model {}.", 100 * std::abs(region.relative),
                  region.sign < 0 ? "less" : "more", place_text(axis, at));
  return region;
}

// By how much more the data are off in the second half of the light along an axis than in the first, in
// standard deviations; positive where the gap grows; nothing where one half has no light. `bins`: of the
// region, nothing elsewhere.
std::optional<double> growth(const Axis& axis, const Residuals& bins) {
  const Residuals cells = along(axis, bins);
  const double middle = cells.expected.sum() / 2;
  Eigen::Index split = 0;
  for (double light = 0; split < cells.expected.size() && light < middle; ++split)
    light += cells.expected(split);
  double relative[2], variance[2];
  for (int half = 0; half < 2; ++half) {
    const auto of_half = [&](const VectorXd& v) {
      return half == 0 ? v.head(split).sum() : v.tail(v.size() - split).sum();
    };
    const double light = of_half(cells.expected);
    if (!(light > 0)) return std::nullopt;
    relative[half] = of_half(cells.off) / light;
    variance[half] = of_half(cells.variance) / (light * light);
  }
  const double error = std::sqrt(variance[0] + variance[1]);
  const double difference = std::abs(relative[1] - relative[0]);
  return (std::abs(relative[1]) > std::abs(relative[0]) ? difference : -difference) / error;
}

Residuals inside(const Axis& axis, const CellRange& range, Residuals bins) {
  const int size = axis.size();
  for (std::size_t b = 0; b < axis.cell.size(); ++b) {
    const int cell = axis.cell[b];
    if (cell >= 0 && (cell - range.first + size) % size < range.cells) continue;
    const auto i = static_cast<Eigen::Index>(b);
    bins.off(i) = bins.variance(i) = bins.expected(i) = 0;
  }
  return bins;
}

std::string sentence_of(const Region& region, const Axis& axis, const Extreme& at, const Axis& distance,
                        const Axis& time, const Residuals& all) {
  constexpr double sure = 3;  // standard deviations
  const Residuals here = inside(axis, at, all);
  std::string text = region.sentence.substr(0, region.sentence.size() - 1);
  if (const auto grows = growth(distance, here); grows && region.axis != "distance")
    text += *grows > sure ? ", growing with distance" : *grows < -sure ? ", fading with distance" : "";
  if (const auto grows = growth(time, here); grows && region.axis != "time")
    text += *grows > sure    ? ", most in late light"
            : *grows < -sure ? ", most in early light"
                             : ", timing unchanged";
  return text + ".";
}

}  // namespace

Whereabouts where_is_the_gap(const Survey& survey, const std::vector<Axis>& axes, const Draws& draws) {
  const Residuals all{residual_of(survey, measured_counts(survey)), variance_of(survey), expected_of(survey)};
  std::vector<Residuals> cells;
  for (const Axis& axis : axes) cells.push_back(along(axis, all));
  const std::vector<std::vector<double>> drawn = drawn_extremes(survey, axes, cells, draws);
  Whereabouts where;
  struct Found {
    std::size_t axis;
    Extreme at;
  };
  std::vector<Found> regions_of;  // by region
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Extreme at = extreme(axes[a], cells[a]);
    where.profiles.push_back(profile_of(axes[a], cells[a]));
    if (at.cells == 0) continue;  // nowhere enough light
    const double ln_p = ln_tail_probability(at.z * at.z / 2, drawn[a]);
    where.regions.push_back(region_of(axes[a], at, cells[a], sigmas_of(ln_p)));
    regions_of.push_back({a, at});
  }
  if (where.regions.empty()) return where;
  const auto first = static_cast<std::size_t>(
      std::max_element(where.regions.begin(), where.regions.end(),
                       [](const Region& a, const Region& b) { return a.significance < b.significance; }) -
      where.regions.begin());
  const auto axis_of = [&](std::string_view name) -> const Axis& {
    return *std::find_if(axes.begin(), axes.end(), [&](const Axis& axis) { return axis.axis == name; });
  };
  const auto [axis, at] = regions_of[first];
  where.regions[first].sentence =
      sentence_of(where.regions[first], axes[axis], at, axis_of("distance"), axis_of("time"), all);
  std::stable_sort(where.regions.begin(), where.regions.end(),
                   [](const Region& a, const Region& b) { return a.significance > b.significance; });
  return where;
}

}  // namespace floe

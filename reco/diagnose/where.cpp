#include "reco/diagnose/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reco/diagnose/score_test.h"

namespace floe {

namespace {

using Eigen::VectorXd;

struct Extreme : CellRange {
  double z = 0;
};

// Of all regions up to half of the axis. A few counts where hardly any light is expected are not Gaussian.
Extreme extreme(const AxisCells& axis, const VectorXd& residual, const VectorXd& variance,
                const VectorXd& expected) {
  constexpr double least_light = 20;
  const auto size = static_cast<int>(residual.size());
  const int most = axis.ordered ? std::max(1, size / 2) : 1;
  Extreme best;
  for (int first = 0; first < size; ++first) {
    double sum = 0, square = 0, light = 0;
    for (int cells = 1; cells <= most; ++cells) {
      int cell = first + cells - 1;
      if (cell >= size && !axis.circular) break;
      cell %= size;
      sum += residual(cell), square += variance(cell), light += expected(cell);
      if (light < least_light) continue;
      const double z = sum / std::sqrt(square);
      if (std::abs(z) > std::abs(best.z)) best = {{first, cells}, z};
    }
  }
  return best;
}

Region region_of(const AxisCells& axis, const Extreme& at, const VectorXd& residual, const VectorXd& expected,
                 double significance) {
  double off = 0, light = 0;
  const auto size = static_cast<int>(residual.size());
  for (int i = 0; i < at.cells; ++i) {
    off += residual((at.first + i) % size);
    light += expected((at.first + i) % size);
  }
  Region region;
  region.axis = axis.axis;
  region.from = axis.low[static_cast<std::size_t>(at.first)];
  region.to = axis.high[static_cast<std::size_t>((at.first + at.cells - 1) % size)];
  region.sign = at.z < 0 ? -1 : 1;
  region.relative = light > 0 ? off / light : 0;
  region.significance = significance;
  region.sentence =
      fmt::format("The data have {:.1f}% {} light than the model {}.", 100 * std::abs(region.relative),
                  region.sign < 0 ? "less" : "more", place_text(axis, at));
  return region;
}

// Of all bins.
struct Residuals {
  VectorXd off, variance, expected;
};

// By how much more the data are off in the second half of the light along an axis than in the first, in
// standard deviations; positive where the gap grows.
double growth(const Axis& axis, const std::vector<char>& inside, const Residuals& all) {
  VectorXd sums[3];
  const VectorXd* values[] = {&all.off, &all.variance, &all.expected};
  for (int k = 0; k < 3; ++k) {
    VectorXd there = *values[k];
    for (Eigen::Index b = 0; b < there.size(); ++b)
      if (!inside[static_cast<std::size_t>(b)]) there(b) = 0;
    sums[k] = axis.sums(there);
  }
  const double middle = sums[2].sum() / 2;
  Eigen::Index split = 0;
  for (double light = 0; split < sums[2].size() && light < middle; ++split) light += sums[2](split);
  double relative[2], variance[2];
  for (int half = 0; half < 2; ++half) {
    const auto of_half = [&](const VectorXd& v) {
      return half == 0 ? v.head(split).sum() : v.tail(v.size() - split).sum();
    };
    const double light = of_half(sums[2]);
    if (!(light > 0)) return 0;
    relative[half] = of_half(sums[0]) / light;
    variance[half] = of_half(sums[1]) / (light * light);
  }
  const double error = std::sqrt(variance[0] + variance[1]);
  const double difference = std::abs(relative[1] - relative[0]);
  return (std::abs(relative[1]) > std::abs(relative[0]) ? difference : -difference) / error;
}

std::string sentence_of(const Region& region, const Axis& axis, const Extreme& at, const Axis& distance,
                        const Axis& time, const Residuals& all) {
  constexpr double clear = 3;  // standard deviations
  const auto size = axis.size();
  std::vector<char> inside;
  for (const int cell : axis.cell) inside.push_back(cell >= 0 && (cell - at.first + size) % size < at.cells);
  std::string text = region.sentence.substr(0, region.sentence.size() - 1);
  if (region.axis != "distance") {
    const double grows = growth(distance, inside, all);
    text += grows > clear ? ", growing with distance" : grows < -clear ? ", fading with distance" : "";
  }
  if (region.axis != "time") {
    const double grows = growth(time, inside, all);
    text += grows > clear    ? ", most in late light"
            : grows < -clear ? ", most in early light"
                             : ", timing unchanged";
  }
  return text + ".";
}

}  // namespace

Whereabouts where_is_the_gap(const Model& model, const Survey& survey, int draws, std::uint64_t seed) {
  const std::vector<Axis> axes = axes_of(model, survey);
  VectorXd expected(survey.bins), variance(survey.bins);
  for (const SurveyRun& run : survey.runs) {
    const Eigen::ArrayXd light = run.expected;
    expected.segment(run.first, run.bins.size()) = light;
    variance.segment(run.first, run.bins.size()) =
        run.data_dispersion * light + run.dispersion * run.scale * light + (run.model_error * light).square();
  }
  const Residuals all{residual_of(survey, measured_counts(survey)), variance, expected};
  std::vector<std::vector<double>> drawn(axes.size(), std::vector<double>(static_cast<std::size_t>(draws)));
  std::vector<VectorXd> variances, lights;
  for (const Axis& axis : axes) {
    variances.push_back(axis.sums(variance));
    lights.push_back(axis.sums(expected));
  }
#pragma omp parallel for schedule(dynamic)
  for (int d = 0; d < draws; ++d) {
    const VectorXd off = residual_of(
        survey, drawn_counts(survey, seed, (std::uint64_t{1} << 32) + static_cast<std::uint64_t>(d)));
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double z = extreme(axes[a], axes[a].sums(off), variances[a], lights[a]).z;
      drawn[a][static_cast<std::size_t>(d)] = z * z / 2;
    }
  }
  Whereabouts where;
  std::vector<Extreme> extremes;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    ResidualProfile profile{axes[a], {}, {}};
    const VectorXd off = axes[a].sums(all.off), &light = lights[a];
    for (Eigen::Index i = 0; i < off.size(); ++i) {
      profile.relative.push_back(light(i) > 0 ? off(i) / light(i) : 0);
      profile.error.push_back(light(i) > 0 ? std::sqrt(variances[a](i)) / light(i) : 0);
    }
    const Extreme at = extreme(axes[a], off, variances[a], light);
    const double ln_p = ln_tail_probability(at.z * at.z / 2, drawn[a]);
    where.regions.push_back(region_of(axes[a], at, off, light, sigmas_of(ln_p)));
    extremes.push_back(at);
    where.profiles.push_back(std::move(profile));
  }
  const auto first = static_cast<std::size_t>(
      std::max_element(where.regions.begin(), where.regions.end(),
                       [](const Region& a, const Region& b) { return a.significance < b.significance; }) -
      where.regions.begin());
  const auto axis_of = [&](std::string_view name) -> const Axis& {
    return *std::find_if(axes.begin(), axes.end(), [&](const Axis& axis) { return axis.axis == name; });
  };
  where.regions[first].sentence = sentence_of(where.regions[first], axes[first], extremes[first],
                                              axis_of("distance"), axis_of("time"), all);
  std::stable_sort(where.regions.begin(), where.regions.end(),
                   [](const Region& a, const Region& b) { return a.significance > b.significance; });
  return where;
}

}  // namespace floe

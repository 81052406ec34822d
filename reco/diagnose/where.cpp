#include "reco/diagnose/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "data/base/constants.h"
#include "reco/diagnose/score_test.h"

namespace floe {

namespace {

using Eigen::VectorXd;

constexpr double radian_in_degrees = 180 / std::numbers::pi;

// A bin of the survey, seen from its flasher.
struct Place {
  const Module* module;
  Vec3 way;         // from the flasher
  double lateness;  // 0..1 of the receiver's light
  int bins;         // of the receiver
};

struct Axis {
  ResidualProfile profile;
  std::vector<int> cell;  // by bin of the survey; -1: not on this axis
};

std::vector<Place> places_of(const Model& model, const Survey& survey) {
  std::vector<Place> places(static_cast<std::size_t>(survey.bins));
  const auto& modules = model.detector->modules();
  for (const SurveyRun& run : survey.runs) {
    const Vec3 flasher = modules[model.detector->index_of(run.data.run.module)].position;
    for (const RunBins::Receiver& receiver : run.bins.receivers())
      for (int i = 0; i < receiver.bins(); ++i)
        places[static_cast<std::size_t>(run.first + receiver.first + i)] = {
            &modules[receiver.module], modules[receiver.module].position - flasher,
            (i + 0.5) / receiver.bins(), receiver.bins()};
  }
  return places;
}

// Cells of equal width from `low` on; what lies beyond the last one is in the last.
Axis ranged(const std::string& name, const std::string& unit, double low, double width, int cells,
            const std::vector<Place>& places, const std::function<double(const Place&)>& value) {
  Axis axis;
  axis.profile.axis = name;
  axis.profile.unit = unit;
  for (int i = 0; i < cells; ++i) {
    axis.profile.low.push_back(low + i * width);
    axis.profile.high.push_back(low + (i + 1) * width);
  }
  for (const Place& place : places) {
    const double at = value(place);
    const int cell = static_cast<int>(std::floor((at - low) / width));
    axis.cell.push_back(std::isfinite(at) ? std::clamp(cell, 0, cells - 1) : -1);
  }
  return axis;
}

// A cell for each string or module.
Axis named(const std::string& name, const std::vector<Place>& places,
           const std::function<ModuleId(const Place&)>& id) {
  Axis axis;
  axis.profile.axis = name;
  axis.profile.ordered = false;
  std::map<ModuleId, int> cells;
  for (const Place& place : places) cells[id(place)] = 0;
  int next = 0;
  for (auto& [module, cell] : cells) {
    cell = next++;
    axis.profile.low.push_back(module.dom > 0 ? module.dom : module.string);
    axis.profile.high.push_back(axis.profile.low.back());
    axis.profile.names.push_back(module.dom > 0 ? fmt::format("{},{}", module.string, module.dom)
                                                : fmt::format("{}", module.string));
  }
  for (const Place& place : places) axis.cell.push_back(cells[id(place)]);
  return axis;
}

std::vector<Axis> axes_of(const Model& model, const Survey& survey) {
  const std::vector<Place> places = places_of(model, survey);
  double top = 1e9, bottom = -1e9;
  for (const Place& place : places) {
    top = std::min(top, origin_depth - place.module->position.z());
    bottom = std::max(bottom, origin_depth - place.module->position.z());
  }
  constexpr double layer = 25, far = 40;
  std::vector<Axis> axes;
  axes.push_back(ranged("depth", "m", layer * std::floor(top / layer), layer,
                        std::max(1, static_cast<int>(std::ceil((bottom - top) / layer)) + 1), places,
                        [](const Place& p) { return origin_depth - p.module->position.z(); }));
  axes.push_back(ranged("azimuth", "deg", 0, 15, 12, places, [](const Place& p) {
    if (p.way.head<2>().norm() < 1) return std::nan("");
    return std::fmod(std::atan2(p.way.y(), p.way.x()) * radian_in_degrees + 360, 180);
  }));
  axes.back().profile.circular = true;
  axes.push_back(ranged("distance", "m", 0, far, 12, places, [](const Place& p) { return p.way.norm(); }));
  axes.push_back(ranged("time", "share of the light", 0, 0.25, 4, places,
                        [](const Place& p) { return p.bins >= 4 ? p.lateness : std::nan(""); }));
  axes.push_back(ranged("arrival angle", "deg", 0, 15, 12, places, [](const Place& p) {
    return std::acos(std::clamp(p.way.z() / std::max(1.0, p.way.norm()), -1.0, 1.0)) * radian_in_degrees;
  }));
  axes.push_back(named("string", places, [](const Place& p) { return ModuleId{p.module->id.string, 0}; }));
  axes.push_back(named("module", places, [](const Place& p) { return p.module->id; }));
  return axes;
}

VectorXd sums_of(const Axis& axis, const VectorXd& values) {
  VectorXd sums = VectorXd::Zero(static_cast<Eigen::Index>(axis.profile.low.size()));
  for (Eigen::Index b = 0; b < values.size(); ++b)
    if (const int cell = axis.cell[static_cast<std::size_t>(b)]; cell >= 0) sums(cell) += values(b);
  return sums;
}

struct Extreme {
  int first = 0, cells = 0;
  double z = 0;
};

// Of all regions up to half of the axis. A few counts where hardly any light is expected are not Gaussian.
Extreme extreme(const ResidualProfile& profile, const VectorXd& residual, const VectorXd& variance,
                const VectorXd& expected) {
  constexpr double least_light = 20;
  const auto size = static_cast<int>(residual.size());
  const int most = profile.ordered ? std::max(1, size / 2) : 1;
  Extreme best;
  for (int first = 0; first < size; ++first) {
    double sum = 0, square = 0, light = 0;
    for (int cells = 1; cells <= most; ++cells) {
      int cell = first + cells - 1;
      if (cell >= size && !profile.circular) break;
      cell %= size;
      sum += residual(cell), square += variance(cell), light += expected(cell);
      if (light < least_light) continue;
      const double z = sum / std::sqrt(square);
      if (std::abs(z) > std::abs(best.z)) best = {first, cells, z};
    }
  }
  return best;
}

std::string place_text(const ResidualProfile& p, const Extreme& at) {
  const auto first = static_cast<std::size_t>(at.first);
  const auto last = static_cast<std::size_t>((at.first + at.cells - 1) % static_cast<int>(p.low.size()));
  const double from = p.low[first], to = p.high[last];
  if (p.axis == "depth") return fmt::format("on modules {:.0f}-{:.0f} m deep", from, to);
  if (p.axis == "azimuth")
    return fmt::format("towards {:.0f}-{:.0f} deg and opposite", from,
                       at.cells > 0 && to < from ? to + 180 : to);
  if (p.axis == "distance") return fmt::format("{:.0f}-{:.0f} m from the flashers", from, to);
  if (p.axis == "time")
    return from == 0 ? fmt::format("in the earliest {:.0f}% of the light", 100 * to)
           : to >= 1 ? fmt::format("in the latest {:.0f}% of the light", 100 * (1 - from))
                     : fmt::format("between {:.0f}% and {:.0f}% of the light", 100 * from, 100 * to);
  if (p.axis == "arrival angle")
    return to <= 90 ? fmt::format("on modules above their flashers ({:.0f}-{:.0f} deg from the vertical)",
                                  from, to)
           : from >= 90
               ? fmt::format("on modules below their flashers ({:.0f}-{:.0f} deg)", from, to)
               : fmt::format("{:.0f}-{:.0f} deg from the vertical, seen from the flashers", from, to);
  return fmt::format("on {} {}", p.axis, p.names[first]);
}

Region region_of(const ResidualProfile& profile, const Extreme& at, const VectorXd& residual,
                 const VectorXd& expected, double significance) {
  double off = 0, light = 0;
  const auto size = static_cast<int>(residual.size());
  for (int i = 0; i < at.cells; ++i) {
    off += residual((at.first + i) % size);
    light += expected((at.first + i) % size);
  }
  Region region;
  region.axis = profile.axis;
  region.from = profile.low[static_cast<std::size_t>(at.first)];
  region.to = profile.high[static_cast<std::size_t>((at.first + at.cells - 1) % size)];
  region.sign = at.z < 0 ? -1 : 1;
  region.relative = light > 0 ? off / light : 0;
  region.significance = significance;
  region.sentence =
      fmt::format("The data have {:.1f}% {} light than the model {}.", 100 * std::abs(region.relative),
                  region.sign < 0 ? "less" : "more", place_text(profile, at));
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
    sums[k] = sums_of(axis, there);
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
  const auto size = static_cast<int>(axis.profile.low.size());
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
  std::vector<Axis> axes = axes_of(model, survey);
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
    variances.push_back(sums_of(axis, variance));
    lights.push_back(sums_of(axis, expected));
  }
#pragma omp parallel for schedule(dynamic)
  for (int d = 0; d < draws; ++d) {
    const VectorXd off = residual_of(
        survey, drawn_counts(survey, seed, (std::uint64_t{1} << 32) + static_cast<std::uint64_t>(d)));
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double z = extreme(axes[a].profile, sums_of(axes[a], off), variances[a], lights[a]).z;
      drawn[a][static_cast<std::size_t>(d)] = z * z / 2;
    }
  }
  Whereabouts where;
  std::vector<Extreme> extremes;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    ResidualProfile& profile = axes[a].profile;
    const VectorXd off = sums_of(axes[a], all.off), &light = lights[a];
    for (Eigen::Index i = 0; i < off.size(); ++i) {
      profile.relative.push_back(light(i) > 0 ? off(i) / light(i) : 0);
      profile.error.push_back(light(i) > 0 ? std::sqrt(variances[a](i)) / light(i) : 0);
    }
    const Extreme at = extreme(profile, off, variances[a], light);
    const double ln_p = ln_tail_probability(at.z * at.z / 2, drawn[a]);
    where.regions.push_back(region_of(profile, at, off, light, sigmas_of(ln_p)));
    extremes.push_back(at);
  }
  const auto first = static_cast<std::size_t>(
      std::max_element(where.regions.begin(), where.regions.end(),
                       [](const Region& a, const Region& b) { return a.significance < b.significance; }) -
      where.regions.begin());
  const auto axis_of = [&](std::string_view name) -> const Axis& {
    return *std::find_if(axes.begin(), axes.end(),
                         [&](const Axis& axis) { return axis.profile.axis == name; });
  };
  where.regions[first].sentence = sentence_of(where.regions[first], axes[first], extremes[first],
                                              axis_of("distance"), axis_of("time"), all);
  for (Axis& axis : axes) where.profiles.push_back(std::move(axis.profile));
  std::stable_sort(where.regions.begin(), where.regions.end(),
                   [](const Region& a, const Region& b) { return a.significance > b.significance; });
  return where;
}

}  // namespace floe

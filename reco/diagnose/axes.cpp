#include "reco/diagnose/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "data/base/constants.h"

namespace floe {

namespace {

constexpr double radian_in_degrees = 180 / std::numbers::pi;

// A bin of the survey, seen from its flasher.
struct BinPlace {
  const Module* module;
  Vec3 way;         // from the flasher
  double lateness;  // 0..1 of the receiver's light
  int bins;         // of the receiver
};

std::vector<BinPlace> places_of(const Model& model, const Survey& survey) {
  std::vector<BinPlace> places(static_cast<std::size_t>(survey.bins));
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
            const std::vector<BinPlace>& places, const std::function<double(const BinPlace&)>& value) {
  Axis axis;
  axis.axis = name;
  axis.unit = unit;
  for (int i = 0; i < cells; ++i) {
    axis.low.push_back(low + i * width);
    axis.high.push_back(low + (i + 1) * width);
  }
  for (const BinPlace& place : places) {
    const double at = value(place);
    axis.cell.push_back(std::isfinite(at) ? static_cast<int>(std::clamp((at - low) / width, 0.0, cells - 1.0))
                                          : -1);
  }
  return axis;
}

// A cell for each string or module.
Axis named(const std::string& name, const std::vector<BinPlace>& places,
           const std::function<ModuleId(const BinPlace&)>& id) {
  Axis axis;
  axis.axis = name;
  axis.ordered = false;
  std::map<ModuleId, int> cells;
  for (const BinPlace& place : places) cells[id(place)] = 0;
  int next = 0;
  for (auto& [module, cell] : cells) {
    cell = next++;
    axis.low.push_back(module.dom > 0 ? module.dom : module.string);
    axis.high.push_back(axis.low.back());
    axis.names.push_back(module.dom > 0 ? fmt::format("{},{}", module.string, module.dom)
                                        : fmt::format("{}", module.string));
  }
  for (const BinPlace& place : places) axis.cell.push_back(cells[id(place)]);
  return axis;
}

}  // namespace

Eigen::VectorXd Axis::sums(const Eigen::VectorXd& of_bins) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(size());
  for (Eigen::Index b = 0; b < of_bins.size(); ++b)
    if (const int at = cell[static_cast<std::size_t>(b)]; at >= 0) sums(at) += of_bins(b);
  return sums;
}

std::vector<Axis> axes_of(const Model& model, const Survey& survey) {
  const std::vector<BinPlace> places = places_of(model, survey);
  double top = 1e9, bottom = -1e9;
  for (const BinPlace& place : places) {
    top = std::min(top, origin_depth - place.module->position.z());
    bottom = std::max(bottom, origin_depth - place.module->position.z());
  }
  constexpr double layer = 25, far = 40;
  std::vector<Axis> axes;
  axes.push_back(ranged("depth", "m", layer * std::floor(top / layer), layer,
                        std::max(1, static_cast<int>(std::ceil((bottom - top) / layer)) + 1), places,
                        [](const BinPlace& p) { return origin_depth - p.module->position.z(); }));
  axes.push_back(ranged("azimuth", "deg", 0, 15, 12, places, [](const BinPlace& p) {
    if (p.way.head<2>().norm() < 1) return std::nan("");
    return std::fmod(std::atan2(p.way.y(), p.way.x()) * radian_in_degrees + 360, 180);
  }));
  axes.back().circular = true;
  axes.push_back(ranged("distance", "m", 0, far, 12, places, [](const BinPlace& p) { return p.way.norm(); }));
  axes.push_back(ranged("time", "share of the light", 0, 0.25, 4, places,
                        [](const BinPlace& p) { return p.bins >= 4 ? p.lateness : std::nan(""); }));
  axes.push_back(ranged("arrival angle", "deg", 0, 15, 12, places, [](const BinPlace& p) {
    return std::acos(std::clamp(p.way.z() / std::max(1.0, p.way.norm()), -1.0, 1.0)) * radian_in_degrees;
  }));
  axes.push_back(named("string", places, [](const BinPlace& p) { return ModuleId{p.module->id.string, 0}; }));
  axes.push_back(named("module", places, [](const BinPlace& p) { return p.module->id; }));
  return axes;
}

std::string place_text(const AxisCells& axis, const CellRange& range) {
  const auto first = static_cast<std::size_t>(range.first);
  const auto last = static_cast<std::size_t>((range.first + range.cells - 1) % axis.size());
  const double from = axis.low[first], to = axis.high[last];
  if (axis.axis == "depth") return fmt::format("on modules {:.0f}-{:.0f} m deep", from, to);
  if (axis.axis == "azimuth")
    return fmt::format("towards {:.0f}-{:.0f} deg and opposite", from,
                       range.cells > 0 && to < from ? to + 180 : to);
  if (axis.axis == "distance") return fmt::format("{:.0f}-{:.0f} m from the flashers", from, to);
  if (axis.axis == "time")
    return from == 0 ? fmt::format("in the earliest {:.0f}% of the light", 100 * to)
           : to >= 1 ? fmt::format("in the latest {:.0f}% of the light", 100 * (1 - from))
                     : fmt::format("between {:.0f}% and {:.0f}% of the light", 100 * from, 100 * to);
  if (axis.axis == "arrival angle")
    return to <= 90 ? fmt::format("on modules above their flashers ({:.0f}-{:.0f} deg from the vertical)",
                                  from, to)
           : from >= 90
               ? fmt::format("on modules below their flashers ({:.0f}-{:.0f} deg)", from, to)
               : fmt::format("{:.0f}-{:.0f} deg from the vertical, seen from the flashers", from, to);
  return fmt::format("on {} {}", axis.axis, axis.names[first]);
}

}  // namespace floe

#include "geometry/detector.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "data/base/hash.h"

namespace floe {

std::string module_name(ModuleId id) {
  return fmt::format("module {},{}", id.string, id.dom);
}

namespace {

void check_module(const Module& module) {
  if (!module.position.allFinite())
    throw InputError(fmt::format("{}: its position is not finite", module_name(module.id)));
  if (!(module.relative_efficiency > 0) || !std::isfinite(module.relative_efficiency))
    throw InputError(fmt::format("{}: found relative efficiency {}; expected a positive number",
                                 module_name(module.id), module.relative_efficiency));
  if (!(std::abs(module.up_axis.norm() - 1) < 1e-6))
    throw InputError(fmt::format("{}: its up axis is not a unit vector", module_name(module.id)));
  if (module.cable_azimuth && !std::isfinite(*module.cable_azimuth))
    throw InputError(fmt::format("{}: the azimuth of its cable is not finite", module_name(module.id)));
}

void check_ids(const std::vector<Module>& sorted) {
  const auto same = std::adjacent_find(sorted.begin(), sorted.end(),
                                       [](const Module& a, const Module& b) { return a.id == b.id; });
  if (same != sorted.end()) throw InputError(fmt::format("{} occurs twice", module_name(same->id)));
}

// Two modules that overlap are also close along any one axis. Sorting along an axis that is skew to
// strings, rows and layers leaves few neighbours to look at.
void check_overlaps(const std::vector<Module>& modules) {
  const Vec3 skew = Vec3(0.5377, 0.3141, 0.7825).normalized();
  std::vector<std::pair<double, std::size_t>> along;
  along.reserve(modules.size());
  for (std::size_t i = 0; i < modules.size(); ++i) along.emplace_back(skew.dot(modules[i].position), i);
  std::sort(along.begin(), along.end());
  for (std::size_t i = 0; i < along.size(); ++i) {
    const Module& one = modules[along[i].second];
    for (std::size_t j = i + 1; j < along.size() && along[j].first - along[i].first < 2 * module_radius;
         ++j) {
      const Module& other = modules[along[j].second];
      const double distance = (one.position - other.position).norm();
      if (distance < 2 * module_radius)
        throw InputError(
            fmt::format("{} and {} overlap: their centres are {:.3f} m apart; expected at least {:.4f} m",
                        module_name(std::min(one.id, other.id)), module_name(std::max(one.id, other.id)),
                        distance, 2 * module_radius));
    }
  }
}

std::map<int, Eigen::Vector2d> mean_positions(const std::vector<Module>& modules) {
  std::map<int, Eigen::Vector2d> sum;
  std::map<int, int> count;
  for (const Module& module : modules) {
    sum.try_emplace(module.id.string, Eigen::Vector2d::Zero()).first->second += module.position.head<2>();
    ++count[module.id.string];
  }
  for (auto& [string, position] : sum) position /= count[string];
  return sum;
}

std::string checksum(const std::vector<Module>& modules, const std::map<int, Eigen::Vector2d>& strings) {
  Hasher hasher;
  hasher.add("detector");
  for (const Module& module : modules) {
    hasher.add(std::int64_t{module.id.string}).add(std::int64_t{module.id.dom});
    for (const double x : module.position) hasher.add(x);
    for (const double x : module.up_axis) hasher.add(x);
    hasher.add(module.relative_efficiency).add(std::int64_t{module.high_qe_spectrum});
    hasher.add(std::int64_t{module.on}).add(std::int64_t{module.cable_azimuth.has_value()});
    hasher.add(module.cable_azimuth.value_or(0));
    if (module.clock_offset != 0) hasher.add("clock").add(module.clock_offset);
  }
  for (const auto& [string, centre] : strings)
    hasher.add(std::int64_t{string}).add(centre.x()).add(centre.y());
  return hasher.hex();
}

}  // namespace

Detector::Detector(std::string name, std::vector<Module> modules, std::map<int, Eigen::Vector2d> drill_holes)
    : name_(std::move(name)), modules_(std::move(modules)) {
  if (modules_.empty())
    throw InputError(fmt::format("detector {}: found no modules; expected at least one", name_));
  std::sort(modules_.begin(), modules_.end(), [](const Module& a, const Module& b) { return a.id < b.id; });
  for (const Module& module : modules_) check_module(module);
  check_ids(modules_);
  check_overlaps(modules_);
  strings_ = mean_positions(modules_);
  for (const auto& [string, centre] : drill_holes) {
    const auto known = strings_.find(string);
    if (known == strings_.end())
      throw InputError(fmt::format("detector {}: found a drill hole of unknown string {}", name_, string));
    known->second = centre;
  }
  hash_ = checksum(modules_, strings_);
}

std::optional<std::size_t> Detector::find(ModuleId id) const {
  const auto place =
      std::lower_bound(modules_.begin(), modules_.end(), id,
                       [](const Module& module, ModuleId wanted) { return module.id < wanted; });
  if (place == modules_.end() || place->id != id) return std::nullopt;
  return static_cast<std::size_t>(place - modules_.begin());
}

std::size_t Detector::index_of(ModuleId id) const {
  if (const auto index = find(id)) return *index;
  throw InputError(
      fmt::format("unknown {}: detector {} has {} modules on {} strings, and it is not among them",
                  module_name(id), name_, size(), strings_.size()));
}

double Detector::largest_relative_efficiency() const {
  double largest = 0;
  for (const Module& module : modules_)
    if (module.on) largest = std::max(largest, module.relative_efficiency);
  return largest;
}

Detector::Extent Detector::extent() const {
  Extent extent{modules_.front().position, modules_.front().position};
  for (const Module& module : modules_) {
    extent.low = extent.low.cwiseMin(module.position);
    extent.high = extent.high.cwiseMax(module.position);
  }
  return extent;
}

}  // namespace floe

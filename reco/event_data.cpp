#include "reco/event_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "data/base/error.h"
#include "reco/likelihood/bayesian_blocks.h"

namespace floe {
namespace {

void check(const Hit& hit, const std::string& event) {
  if (std::isfinite(hit.time) && std::isfinite(hit.charge) && hit.charge >= 0) return;
  throw InputError({"event " + event, 0},
                   "a hit of module " + std::to_string(hit.module.string) + "," +
                       std::to_string(hit.module.dom) + " with time " + std::to_string(hit.time) +
                       " ns and charge " + std::to_string(hit.charge),
                   "finite times and charges that are not negative");
}

void sort_by_time(ModuleData& data) {
  std::vector<std::size_t> order(data.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return data.times[a] < data.times[b]; });
  ModuleData sorted = data;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.times[i] = data.times[order[i]];
    sorted.charges[i] = data.charges[order[i]];
  }
  data = std::move(sorted);
}

void cut_into_bins(ModuleData& data, double begin, double end) {
  data.edges = block_edges(data.times, data.charges, begin, end);
  data.counts.assign(data.edges.size() + 1, 0);
  for (std::size_t i = 0; i < data.times.size(); ++i) {
    const auto bin =
        std::upper_bound(data.edges.begin(), data.edges.end(), data.times[i]) - data.edges.begin();
    data.counts[static_cast<std::size_t>(bin)] += data.charges[i];
  }
}

}  // namespace

EventData::EventData(const Detector& detector, const Event& event)
    : detector_(&detector), id_(event.id), repeats_(event.repeats) {
  if (!(std::isfinite(repeats_) && repeats_ > 0))
    throw InputError({"event " + id_, 0}, "an average over " + std::to_string(repeats_) + " repetitions",
                     "a number of repetitions above 0");
  std::vector<ModuleData> modules(detector.size());
  first_ = std::numeric_limits<double>::infinity();
  last_ = -first_;
  for (const Hit& hit : event.hits) {
    check(hit, id_);
    const std::size_t index = detector.index_of(hit.module);
    if (!detector.modules()[index].on || hit.charge == 0) continue;
    modules[index].times.push_back(hit.time);
    modules[index].charges.push_back(hit.charge * repeats_);
    first_ = std::min(first_, hit.time);
    last_ = std::max(last_, hit.time);
  }
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (!detector.modules()[i].on) continue;
    if (modules[i].times.empty()) {
      dark_.push_back(index);
      continue;
    }
    ModuleData& data = lit_.emplace_back(std::move(modules[i]));
    data.module = index;
    data.charge = std::accumulate(data.charges.begin(), data.charges.end(), 0.0);
    charge_ += data.charge;
    sort_by_time(data);
    cut_into_bins(data, first_ - margin, last_ + margin);
  }
}

void EventData::require_enough_light() const {
  if (lit_.size() >= least_modules && charge_ >= least_charge) return;
  throw NoResult("not enough light: " + std::to_string(lit_.size()) + " modules with hits and " +
                 std::to_string(std::lround(charge_)) + " photoelectrons; a fit needs " +
                 std::to_string(least_modules) + " modules and " + std::to_string(std::lround(least_charge)) +
                 " photoelectrons");
}

std::size_t EventData::bins() const {
  std::size_t result = dark_.size();
  for (const ModuleData& data : lit_) result += data.counts.size();
  return result;
}

std::vector<std::size_t> EventData::brightest(std::size_t n) const {
  std::vector<std::size_t> order(lit_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lit_[a].charge > lit_[b].charge; });
  order.resize(std::min(n, order.size()));
  return order;
}

}  // namespace floe

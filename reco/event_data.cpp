#include "reco/event_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "data/base/error.h"
#include "reco/likelihood/bayesian_blocks.h"
#include "reco/spread_charge.h"
#include "response/afterpulses.h"

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
    sorted.widths[i] = data.widths[order[i]];
  }
  data = std::move(sorted);
}

bool concerns(const TimeWindow& window, ModuleId module) {
  return !window.module || *window.module == module;
}

bool is_left_out(std::span<const TimeWindow> windows, ModuleId module, double time) {
  return std::any_of(windows.begin(), windows.end(), [&](const TimeWindow& window) {
    return concerns(window, module) && time >= window.begin && time < window.end;
  });
}

// Averages over repetitions have scattered less; what they say is not asked, as cascades come once.
double dispersion_of_single_pulses(const std::vector<ModuleData>& modules) {
  constexpr int least = 20;
  int count = 0;
  double sum = 0, squares = 0;
  for (const ModuleData& module : modules) {
    if (module.charges.size() != 1) continue;
    ++count;
    sum += module.charge;
    squares += module.charge * module.charge;
  }
  return count < least ? 1 : std::max(1.0, squares / sum);
}

}  // namespace

EventData::EventData(const Detector& detector, const Event& event, const DataSelection& asked)
    : detector_(&detector), selection_(asked), id_(event.id), repeats_(event.repeats) {
  check(asked);
  if (event.readout) learn_from(*event.readout);
  const DataSelection& selection = selection_;
  if (!(std::isfinite(repeats_) && repeats_ > 0))
    throw InputError({"event " + id_, 0}, "an average over " + std::to_string(repeats_) + " repetitions",
                     "a number of repetitions above 0");
  std::vector<bool> used(detector.size());
  for (std::size_t i = 0; i < detector.size(); ++i) used[i] = detector.modules()[i].on;
  for (const ModuleId module : selection.bad) used[detector.index_of(module)] = false;
  // Modules that the detector does not have are errors wherever they are named.
  for (const TimeWindow& window : selection.left_out)
    if (window.module) detector.index_of(*window.module);
  for (const auto& [module, rate] : selection.noise_of) detector.index_of(module);

  std::vector<ModuleData> modules(detector.size());
  first_ = std::numeric_limits<double>::infinity();
  last_ = -first_;
  for (const Hit& hit : event.hits) {
    check(hit, id_);
    const std::size_t index = detector.index_of(hit.module);
    if (!used[index] || hit.charge == 0) continue;
    if (afterpulses_.share > 0)
      modules[index].afterpulse_sources.emplace_back(hit.time, hit.charge * repeats_);
    if (is_left_out(selection.left_out, hit.module, hit.time)) continue;
    modules[index].times.push_back(hit.time);
    modules[index].charges.push_back(hit.charge * repeats_);
    modules[index].widths.push_back(hit.width > 0 ? hit.width : 0);  // unknown: as of photons
    first_ = std::min(first_, hit.time);
    last_ = std::max(last_, hit.time);
  }
  if (first_ > last_) first_ = last_ = 0;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (!used[i]) continue;
    const ModuleId id = detector.modules()[i].id;
    const bool cut = std::any_of(selection.left_out.begin(), selection.left_out.end(),
                                 [&](const TimeWindow& window) { return concerns(window, id); });
    if (modules[i].times.empty() && !cut) {
      dark_.push_back(index);
      continue;
    }
    ModuleData& data = lit_.emplace_back(std::move(modules[i]));
    data.module = index;
    data.charge = std::accumulate(data.charges.begin(), data.charges.end(), 0.0);
    charge_ += data.charge;
    sort_by_time(data);
    data.saturated = data.charge >= selection.charge_cap * repeats_;
    cut_into_bins(data, block_edges(data.times, data.charges, begin(), end()));
  }
  if (event.readout) charge_dispersion_ = dispersion_of_single_pulses(lit_);
}

// Modules that were off, times that cannot be used, and dark noise unless the user says how much there is.
void EventData::learn_from(const Readout& readout) {
  const bool noise_asked = selection_.noise_rate > 0 || !selection_.noise_of.empty();
  for (const RecordingModule& module : *readout.modules) {
    if (!module.on) selection_.bad.push_back(module.id);
    if (!noise_asked) selection_.noise_of[module.id] = module.noise_rate;
  }
  const double afterwards = std::numeric_limits<double>::infinity();
  for (const UnusableTimes& times : readout.unusable) {
    selection_.left_out.push_back({times.module, times.begin, times.end});
    // Nobody knows how many afterpulses follow light that was too bright to be measured.
    if (times.reason == UnusableTimes::Reason::saturated && readout.afterpulses.share > 0)
      selection_.left_out.push_back({times.module, times.begin + readout.afterpulses.begin, afterwards});
  }
  afterpulses_ = readout.afterpulses;
}

// Afterpulses of one event that follow the module's charge between two times, on average.
double EventData::afterpulses_between(const ModuleData& data, double low, double high) const {
  if (afterpulses_.share <= 0) return 0;
  double sum = 0;
  for (const auto& [time, charge] : data.afterpulse_sources)
    sum +=
        charge * (afterpulses_until(afterpulses_, high - time) - afterpulses_until(afterpulses_, low - time));
  return afterpulses_.share * sum / repeats_;
}

void EventData::cut_into_bins(ModuleData& data, std::vector<double> edges) const {
  if (data.saturated) edges.clear();
  const ModuleId id = detector_->modules()[data.module].id;
  for (const TimeWindow& window : selection_.left_out)
    if (concerns(window, id) && !data.saturated)
      for (const double edge : {window.begin, window.end})
        if (std::isfinite(edge)) edges.push_back(edge);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  data.edges = std::move(edges);
  const std::size_t bins = data.edges.size() + 1;
  data.counts.assign(bins, 0);
  data.noise.assign(bins, 0);
  data.left_out.assign(bins, false);
  if (data.saturated) {
    data.counts[0] = selection_.charge_cap * repeats_;
    data.noise[0] = selection_.noise(id) * 1e-9 * (end() - begin());
    return;
  }
  for (std::size_t b = 0; b < bins; ++b) {
    const double low = b == 0 ? begin() : std::max(begin(), data.edges[b - 1]);
    const double high = b + 1 == bins ? end() : std::min(end(), data.edges[b]);
    data.noise[b] =
        high > low ? selection_.noise(id) * 1e-9 * (high - low) + afterpulses_between(data, low, high) : 0;
    // Edges of windows are edges of bins: a bin lies inside or outside.
    const double inside = data.edges.empty() ? 0
                          : b == 0           ? data.edges[0] - 1
                          : b + 1 == bins    ? data.edges[b - 1] + 1
                                             : 0.5 * (data.edges[b - 1] + data.edges[b]);
    data.left_out[b] = is_left_out(selection_.left_out, id, inside);
  }
  for (std::size_t i = 0; i < data.times.size(); ++i)
    add_spread(data.times[i], data.widths[i], data.charges[i], data.edges, data.counts);
  for (std::size_t b = 0; b < bins; ++b)
    if (data.left_out[b]) data.counts[b] = 0;
}

EventData EventData::with_edges(std::span<const std::vector<double>> edges) const {
  assert(edges.size() == lit_.size());
  EventData result = *this;
  for (std::size_t i = 0; i < edges.size(); ++i) cut_into_bins(result.lit_[i], edges[i]);
  return result;
}

double EventData::dark_noise(std::uint32_t module) const {
  return selection_.noise(detector_->modules()[module].id) * 1e-9 * (end() - begin());
}

void EventData::require_enough_light() const {
  const auto modules = static_cast<std::size_t>(
      std::count_if(lit_.begin(), lit_.end(), [](const ModuleData& data) { return data.charge > 0; }));
  double noise = 0;  // of all modules that are on
  for (const ModuleData& data : lit_) noise += repeats_ * dark_noise(data.module);
  for (const std::uint32_t module : dark_) noise += repeats_ * dark_noise(module);
  if (modules >= least_modules && charge_ - noise >= least_charge) return;
  if (modules >= least_modules && charge_ >= least_charge)
    throw NoResult(
        fmt::format("not enough light: {:.0f} photoelectrons, of which {:.0f} are dark noise; a fit "
                    "needs {:.0f} more than that",
                    charge_, noise, least_charge));
  throw NoResult("not enough light: " + std::to_string(modules) + " modules with hits and " +
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
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < lit_.size(); ++i)
    if (lit_[i].charge > 0) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lit_[a].charge > lit_[b].charge; });
  order.resize(std::min(n, order.size()));
  return order;
}

}  // namespace floe

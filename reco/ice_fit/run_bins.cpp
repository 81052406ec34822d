#include "reco/ice_fit/run_bins.h"

#include <algorithm>

#include "reco/spread_charge.h"

namespace floe {

namespace {

std::vector<double> quantiles(std::vector<double>& times, int bins) {
  std::sort(times.begin(), times.end());
  std::vector<double> edges;
  for (int i = 1; i < bins; ++i) {
    const double edge = times[times.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(bins)];
    if (edge > (edges.empty() ? times.front() : edges.back())) edges.push_back(edge);
  }
  return edges;
}

}  // namespace

RunBins::RunBins(std::span<const SimulatedHit> hits, double scale, const std::vector<char>& used,
                 const Rules& rules)
    : receiver_of_(used.size(), -1) {
  std::vector<std::vector<double>> times(used.size());
  for (const SimulatedHit& hit : hits)
    if (used[hit.module]) times[hit.module].push_back(hit.time);
  for (std::uint32_t module = 0; module < used.size(); ++module) {
    const auto simulated = static_cast<double>(times[module].size());
    if (scale * simulated < rules.least_counts) continue;
    const double wanted = simulated * std::min(scale / rules.counts_a_bin, 1 / rules.hits_a_bin);
    const int bins = std::clamp(static_cast<int>(wanted), 1, rules.most_bins);
    receiver_of_[module] = static_cast<int>(receivers_.size());
    receivers_.push_back({module, size_, quantiles(times[module], bins)});
    size_ += receivers_.back().bins();
  }
}

std::vector<int> RunBins::receiver_of_bin() const {
  std::vector<int> receivers;
  for (std::size_t i = 0; i < receivers_.size(); ++i)
    receivers.insert(receivers.end(), static_cast<std::size_t>(receivers_[i].bins()), static_cast<int>(i));
  return receivers;
}

int RunBins::bin(std::uint32_t module, double time) const {
  const int receiver = receiver_of_[module];
  if (receiver < 0) return -1;
  const Receiver& r = receivers_[static_cast<std::size_t>(receiver)];
  const auto above = std::upper_bound(r.inner_edges.begin(), r.inner_edges.end(), time);
  return r.first + static_cast<int>(above - r.inner_edges.begin());
}

Eigen::VectorXd RunBins::counts(std::span<const SimulatedHit> hits, double delay) const {
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(size_);
  for (const SimulatedHit& hit : hits)
    if (const int at = bin(hit.module, hit.time + delay); at >= 0) counts(at) += 1;
  return counts;
}

void RunBins::add_spread(std::uint32_t module, double time, double width, double charge,
                         Eigen::VectorXd& counts) const {
  const int receiver = receiver_of_[module];
  if (receiver < 0) return;
  const Receiver& r = receivers_[static_cast<std::size_t>(receiver)];
  floe::add_spread(time, width, charge, r.inner_edges,
                   {counts.data() + r.first, static_cast<std::size_t>(r.bins())});
}

}  // namespace floe

#include "reco/ice_fit/receiver_efficiencies.h"

#include <set>

namespace floe {

EfficiencyColumns::EfficiencyColumns(std::span<const RunBins* const> runs, int first) {
  std::set<std::uint32_t> modules;
  for (const RunBins* bins : runs)
    for (const RunBins::Receiver& receiver : bins->receivers()) modules.insert(receiver.module);
  for (const std::uint32_t module : modules) {
    columns_[module] = first + static_cast<int>(modules_.size());
    modules_.push_back(module);
  }
}

std::vector<int> EfficiencyColumns::of_receivers(const RunBins& bins) const {
  std::vector<int> columns;
  if (modules_.empty()) return columns;
  for (const RunBins::Receiver& receiver : bins.receivers()) columns.push_back(columns_.at(receiver.module));
  return columns;
}

Eigen::VectorXd ProfiledSystem::changes(const Eigen::VectorXd& step) const {
  return first_changes + slopes * step;
}

// With g the gap, I the information, N the noise, p the columns kept and e the efficiencies, whose
// information is diagonal as no bin belongs to two receivers: e = (I_ee + 1/width^2)^-1 (g_e - I_ep p), put
// into the equations for p. A true change of width^2 that the prior draws back leaves the last term of the
// noise.
ProfiledSystem profile_efficiencies(const ScoreSystem& all, int efficiencies, double width) {
  const Eigen::Index e = efficiencies, p = all.gap.size() - e;
  ProfiledSystem result{ScoreSystem(static_cast<int>(p)), Eigen::VectorXd(e), Eigen::VectorXd(e),
                        Eigen::MatrixXd(e, p)};
  const auto keep = [&](const Eigen::MatrixXd& matrix) { return matrix.topLeftCorner(p, p); };
  result.system.gap = all.gap.head(p);
  result.system.slope = keep(all.slope);
  result.system.information = keep(all.information);
  result.system.noise = keep(all.noise);
  if (e == 0) return result;

  const double prior = 1 / (width * width);
  const Eigen::VectorXd inverse = (all.information.diagonal().tail(e).array() + prior).inverse();
  const Eigen::MatrixXd shared = all.information.topRightCorner(p, e);
  const Eigen::MatrixXd share = shared * inverse.asDiagonal();
  const Eigen::MatrixXd crossed = share * all.noise.bottomLeftCorner(e, p);
  const Eigen::MatrixXd left = width * prior * share;
  result.system.gap -= share * all.gap.tail(e);
  result.system.slope -= share * all.slope.bottomLeftCorner(e, p);
  result.system.information -= share * shared.transpose();
  result.system.noise += share * all.noise.bottomRightCorner(e, e) * share.transpose() - crossed -
                         crossed.transpose() + left * left.transpose();
  result.first_changes = inverse.cwiseProduct(all.gap.tail(e));
  result.slopes = -share.transpose();
  result.errors = inverse.cwiseSqrt();
  return result;
}

}  // namespace floe

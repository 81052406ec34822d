// Receivers' relative efficiencies as nuisances of an ice fit: each known to a width beforehand, and
// profiled.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/score_system.h"

namespace floe {

// Which columns of a system hold the efficiencies of which modules: one for every module that receives light
// of any run.
class EfficiencyColumns {
 public:
  EfficiencyColumns() = default;  // none: efficiencies are as the model has them
  EfficiencyColumns(std::span<const RunBins* const> runs, int first);
  int count() const { return static_cast<int>(modules_.size()); }
  // Indices into Detector::modules(), in the order of their columns.
  const std::vector<std::uint32_t>& modules() const { return modules_; }
  // By receiver of a run, as RunColumns has them; none when there are no columns.
  std::vector<int> of_receivers(const RunBins& bins) const;

 private:
  std::vector<std::uint32_t> modules_;
  std::map<std::uint32_t, int> columns_;
};

// A system without its last columns, which are efficiencies: relative changes with a Gaussian prior about
// none, solved for as functions of the others. The noise of what is left holds what the prior leaves open.
struct ProfiledSystem {
  ScoreSystem system;
  Eigen::VectorXd changes(const Eigen::VectorXd& step) const;  // the efficiencies' at a step of the others

  Eigen::VectorXd first_changes, errors;  // at no step, and about those of any step
  Eigen::MatrixXd slopes;                 // efficiencies x others: d change / d step
};
ProfiledSystem profile_efficiencies(const ScoreSystem& all, int efficiencies, double width);

}  // namespace floe

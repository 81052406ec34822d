// Rounds of an ice fit, solved together: as much light as all of them have.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "reco/ice_fit/score_system.h"

namespace floe {

class RoundMemory {
 public:
  // Mean of this round's system and of those remembered, all where the fit is now.
  ScoreSystem with(const ScoreSystem& system);
  // The fit goes on by `step`, of the system's columns: scores are linear in small steps.
  void move(const Eigen::VectorXd& step);
  // After a step that is too long for that.
  void forget() { sum_.reset(); }

 private:
  std::optional<ScoreSystem> sum_;
  int rounds_ = 0;  // in the sum
};

}  // namespace floe

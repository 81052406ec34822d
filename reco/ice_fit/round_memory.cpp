#include "reco/ice_fit/round_memory.h"

namespace floe {

ScoreSystem RoundMemory::with(const ScoreSystem& system) {
  if (sum_)
    *sum_ += system;
  else
    sum_ = system, rounds_ = 0;
  ++rounds_;
  ScoreSystem mean = *sum_;
  const double share = 1.0 / rounds_;
  mean.gap *= share, mean.slope *= share, mean.information *= share, mean.noise *= share;
  // Rounds have the same data, and simulations of their own.
  mean.simulation_noise *= share;
  mean.noise -= (1 - share) * mean.simulation_noise;
  mean.simulation_noise *= share;
  return mean;
}

void RoundMemory::move(const Eigen::VectorXd& step) {
  if (sum_) sum_->gap -= sum_->slope * step;
}

}  // namespace floe

// The weights that make seven sums of all bins: see calibrated_score.h. Theory: docs/theory/direct_fit.md.
#pragma once

#include <span>
#include <vector>

#include "reco/direct_fit/emulator.h"

namespace floe {

// Simulated less expected count of every bin in one event, for a simulation whose cascade has the local
// numbers `p` around the emulator's origin and whose vertex is at `time` [ns]. In the order of
// emulator.bins(); the simulation's brightness p(6) is taken out.
std::vector<double> simulation_gaps(const EventData& data, const Emulator& emulator,
                                    const LightSample& sample, Vector7 p, double time);

// For every bin the gradient of the emulator's ln(expectation) over its variance, of data, finite simulation
// and model error; less where the emulator cannot be believed. In the order of emulator.bins().
class ScoreWeights {
 public:
  // `all_repeats`: size of the simulations that say what the sums mean, in events. `judges`: simulations near
  // the origin that the sums are not calibrated with. `position_error` [m]: how well the place is known.
  ScoreWeights(const EventData& data, const Emulator& emulator, double all_repeats,
               std::span<const LightSample* const> judges, double position_error);

  const Vector7& operator[](std::size_t bin) const { return weights_[bin]; }
  // Of a bin's count about its expectation, with finite simulation and model error, in units of Poisson's.
  double relative_variance(std::size_t bin) const { return relative_variance_[bin]; }
  // Variance of the data's sums from what modules were let float by.
  const Matrix7& distrust() const { return distrust_; }
  // Variance of the sums of Poisson counts in one event.
  Matrix7 poisson_variance() const;

 private:
  void weaken_modules(std::span<const LightSample* const> judges);
  void weaken_module(std::size_t begin, std::size_t end, std::span<const LightSample* const> judges,
                     std::span<const std::vector<double>> gaps);
  void distrust_module(std::size_t begin, std::size_t end, double position_error);
  template <class Do>
  void for_each_module(Do what) const;

  const EventData& data_;
  const Emulator& emulator_;
  double finite_;  // what finite simulation adds to the variance of counts, in units of Poisson's
  std::vector<Vector7> weights_;
  std::vector<double> means_, relative_variance_;  // of the data
  std::vector<double> by_time_;                    // d ln(expectation) / dt
  Matrix7 distrust_ = Matrix7::Zero();
};

}  // namespace floe

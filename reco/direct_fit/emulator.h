// The expected light of cascades near a point, learnt from a few simulations around it: what lets a
// fit of seven parameters work with some dozens of simulations. Theory: docs/theory/direct_fit.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reco/direct_fit/emulator_training.h"
#include "reco/likelihood/limited_simulation.h"

namespace floe {

struct EmulatorSettings {
  CascadeKind kind = CascadeKind::electron;
  double model_error = 0.1;
  double position_step = 10;    // size of the design around the origin [m]
  double direction_step = 0.2;  // [rad]
  int threads = 0;
};

// For every bin (module x time) the expectation at local parameters p (see LocalFrame) is
//   mu(p) = point light(p) exp(shape(p) + p_7 + c_0 + c . p_1..5) P(tau) / P(0) + noise,
// with a common shape and c from regressions over all simulations (see train), and P(tau) the share of the
// module's light in the bin when it arrives later by tau = p_6 + slowness x (change of distance), from the
// simulations' arrival times together.
class Emulator {
 public:
  struct Evaluation {
    double log_mean;                       // ln(expected counts of one event)
    Eigen::Matrix<double, 7, 1> gradient;  // of log_mean with respect to p
  };
  struct Bin {
    double data = 0;         // counts in all repetitions together
    double noise = 0;        // expected dark counts of one event
    bool saturated = false;  // `data` is what there is at least
    bool left_out = false;
    double effective_counts = 0;  // the simulation's size: 1 / variance of ln mu
    std::uint32_t module = 0;     // bins of one module follow each other
  };

  // `samples`: at least one, near `origin`. `data` must outlive the emulator.
  Emulator(const EventData& data, const MeanIce& ice, const LightCentre& origin,
           std::span<const LightSample* const> samples, const EmulatorSettings& settings);

  const LocalFrame& frame() const { return frame_; }
  const EmulatorSettings& settings() const { return settings_; }
  double repeats() const { return data_->repeats(); }
  std::span<const Bin> bins() const { return bins_; }

  // All bins' expectations at p, in the order of bins().
  void evaluate(const Vector7& p, std::vector<Evaluation>& result) const;
  // -ln L of one bin when ln(expected counts of one event) is `log_mean`.
  BinLikelihood likelihood(const Bin& bin, double log_mean) const;
  // -ln L of the data at p.
  double neg_llh(const Vector7& p) const;
  // Expected Fisher information at p, with the simulation's noise and the model error.
  Matrix7 information(const Vector7& p) const;

 private:
  void evaluate_module(const ModuleLight& module, std::size_t first_bin, const Vector7& p,
                       const LightCentre& at, const LocalFrame::DirectionChange& turn,
                       std::vector<Evaluation>& result) const;

  const EventData* data_;
  LocalFrame frame_;
  EmulatorSettings settings_;
  std::vector<ModuleLight> modules_;
  std::vector<Bin> bins_;
};

}  // namespace floe

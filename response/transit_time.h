// When a photoelectron's charge arrives at the anode: the spread of the transit time, prepulses and late
// pulses (arXiv:1002.2442, section 4; arXiv:1612.05093, section 3.2).
#pragma once

#include <vector>

#include "data/readout.h"
#include "propagation/engine/random.h"

namespace floe {

struct TransitTimeSettings {
  double rise = 1.2, fall = 2.7;  // of the peak: widths of the two halves of a Gaussian [ns]
  double prepulse_share = 0.003, prepulse_time = -31.8, prepulse_charge = 0.05;
  // Late pulses, three kinds: shares, and times after the peak [ns].
  double shoulder_share = 0.015, shoulder_begin = 25, shoulder_end = 65;
  double late_peak_share = 0.020, late_peak_time = 71, late_peak_width = 4;
  double tail_share = 0.002, tail_begin = 85, tail_end = 160;
};

class TransitTime {
 public:
  // Shares in 0..1 with a sum of at most 1, widths of at least 0, every time before its end.
  explicit TransitTime(const TransitTimeSettings& settings = {}) : settings_(settings) {}

  // The peak's density around its mean, which is 0 by calibration: two halves of Gaussians, each with a share
  // in proportion to its width, so that they meet without a step [1/ns].
  double peak_density(double time) const;

  struct Arrival {
    double delay;         // [ns]; of photons in the peak 0 on average
    double charge_share;  // of what the photoelectron would have had: below 1 for prepulses
    PhotoelectronOrigin origin;
  };
  Arrival draw(RandomStream& stream) const;

  // All of it but prepulses, which stay below the discriminator, as fits expect it: in boxes, those of the
  // peak narrow.
  std::vector<ExpectedDelay> expected_delays() const;

 private:
  double peak_mean() const;              // of the two halves, from where they meet [ns]
  double peak_below(double time) const;  // integral of the density
  double peak_share() const;             // of all photoelectrons

  TransitTimeSettings settings_;
};

}  // namespace floe

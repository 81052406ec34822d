// Dark noise of a module in the ice: single photoelectrons at random, and bursts of scintillation and decays
// in the glass whose pulses follow one another in log-normal gaps (arXiv:1612.05093, section 3.2; M. Larson,
// "Simulation and identification of non-Poissonian noise triggers in the IceCube neutrino detector", Univ. of
// Alabama, 2013).
#pragma once

#include <vector>

#include "propagation/engine/random.h"

namespace floe {

struct DarkNoiseSettings {
  double single_rate = 240;    // of single photoelectrons [1/s]
  double burst_rate = 91;      // of bursts [1/s]
  double burst_size = 3.5;     // photoelectrons of a burst, on average (Poisson)
  double gap_log10_mean = -6;  // of the decimal logarithm of the gaps in seconds
  double gap_log10_width = 0.85;
  double high_efficiency_factor = 1.39;  // rates of modules of high quantum efficiency over those of others

  double rate() const { return single_rate + burst_rate * burst_size; }  // of photoelectrons, nominal [1/s]
};

// Times of dark photoelectrons in [begin, end) [ns], in no order; `factor` multiplies the rates. Bursts may
// have begun up to a millisecond before.
std::vector<double> draw_dark_noise(const DarkNoiseSettings& settings, double factor, double begin,
                                    double end, RandomStream& stream);

}  // namespace floe

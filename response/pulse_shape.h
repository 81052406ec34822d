// The voltage that one photoelectron leaves behind an amplifier: (exp(-t/b1) + exp(t/b2))^-8,
// arXiv:1612.05093, section 4.2.
#pragma once

#include <span>

#include "data/readout.h"

namespace floe {

class PulseShape {
 public:
  // b1 and b2 above 0 [ns]: the rise and the fall.
  PulseShape(double b1, double b2);

  // Of the pulse of a photoelectron at time 0, which is where the pulse has risen to half its peak; its
  // integral over time is 1 [1/ns].
  double operator()(double time) const;

  double peak() const { return (*this)(peak_time_); }
  double peak_time() const { return peak_time_; }
  // Outside of these the pulse is below 1e-4 of its peak [ns].
  double begin() const { return begin_; }
  double end() const { return end_; }

 private:
  double raw(double time) const;  // without normalisation, from its own zero

  double b1_, b2_, norm_ = 1, half_rise_ = 0, peak_time_ = 0, begin_ = 0, end_ = 0;
};

// The sum of the pulses of photoelectrons, in order of time, at one time [1/ns].
double sum_of_pulses(const PulseShape& shape, std::span<const Photoelectron> photoelectrons, double time);

}  // namespace floe

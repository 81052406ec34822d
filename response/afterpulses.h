// Afterpulses: ions that the photoelectrons' cascade sets free drift back to the photocathode
// (arXiv:1002.2442, section 6). The structure of the time distribution, several broad peaks, is smoothed to
// one even in the logarithm of time.
#pragma once

#include <cmath>

#include "data/readout.h"
#include "response/draws.h"

namespace floe {

// Share of all afterpulses that have come after `delay` [ns].
inline double afterpulses_until(const ExpectedAfterpulses& after, double delay) {
  if (delay <= after.begin) return 0;
  if (delay >= after.end) return 1;
  return std::log(delay / after.begin) / std::log(after.end / after.begin);
}

inline double draw_afterpulse_delay(const ExpectedAfterpulses& after, RandomStream& stream) {
  return after.begin * std::pow(after.end / after.begin, stream.uniform());
}

}  // namespace floe

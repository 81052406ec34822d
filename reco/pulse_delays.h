// When the pulses of simulated hits come, counted from their light: tubes spread them, some come late.
#pragma once

#include <cstdint>
#include <span>

#include "data/readout.h"
#include "propagation/engine/simulator.h"

namespace floe {

// The same for the same photon at the same module, so that simulations with common random numbers keep them.
class PulseDelays {
 public:
  // `delays` must outlive this; seed and stream are those of the simulation.
  PulseDelays(std::span<const ExpectedDelay> delays, std::uint64_t seed, std::uint64_t stream);
  float operator()(const SimulatedHit& hit) const;  // [ns]

 private:
  std::span<const ExpectedDelay> delays_;
  std::uint64_t seed_, stream_;
};

}  // namespace floe

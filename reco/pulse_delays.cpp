#include "reco/pulse_delays.h"

#include "propagation/engine/random.h"

namespace floe {

namespace {

constexpr std::uint64_t purpose = std::uint64_t{0x64656c61} << 32, most_modules = 1 << 20;

}  // namespace

PulseDelays::PulseDelays(std::span<const ExpectedDelay> delays, std::uint64_t seed, std::uint64_t stream)
    : delays_(delays), seed_(seed), stream_(stream ^ purpose) {}

float PulseDelays::operator()(const SimulatedHit& hit) const {
  if (delays_.empty()) return 0;
  RandomStream random(seed_, stream_, hit.photon * most_modules + hit.module);
  double kind = random.uniform();
  for (const ExpectedDelay& delay : delays_)
    if ((kind -= delay.share) < 0)
      return static_cast<float>(delay.begin + (delay.end - delay.begin) * random.uniform());
  return 0;
}

}  // namespace floe

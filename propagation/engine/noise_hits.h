// Hits that no light makes: radioactive decays in a module's glass and its tube's dark current
// (arXiv:1612.05093), here at a constant rate, each on its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

inline constexpr double seconds_per_nanosecond = 1e-9;

// Photons of a simulation have smaller numbers.
inline constexpr std::uint64_t first_noise_hit = std::uint64_t{1} << 62;
// Whether a photon's path led to the hit; there is none to noise and to afterpulses.
inline bool has_path(const SimulatedHit& hit) {
  return hit.photon < first_noise_hit;
}

struct NoiseWindow {
  double from = 0, to = 5000;  // times of hits in one readout [ns]
  double readouts = 1;         // that the hits are the sum of; need not be whole
  double known_rate = 0;       // of every module, in addition to the model's [Hz]: what a record says of it
};

// Of all modules that are on, at the model's rate (Model::noise_rate): a Poisson number, at times spread
// evenly over the window. Their wavelength and directions are not numbers; `photon` counts from
// first_noise_hit. None from the module `emitter`.
std::vector<SimulatedHit> noise_hits(const Model& model, const NoiseWindow& window,
                                     std::optional<std::size_t> emitter, std::uint64_t seed,
                                     std::uint64_t stream);

}  // namespace floe

// Flasher runs of floe's own, taken as data.
#pragma once

#include <cstdint>
#include <span>

#include "reco/ice_fit/run_data.h"
#include "reco/paper_figures/emitters.h"

namespace floe {

// One flash of each emitter in this ice. `first_stream`: of its random numbers, one for each emitter.
FlasherData pseudo_data(const Model& truth, std::span<const Emitter> emitters, double photons,
                        std::uint64_t seed, std::uint64_t first_stream, int threads);

}  // namespace floe

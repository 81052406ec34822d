// Random numbers of the walk through crystals, in the order in which a photon draws them.
//
// A photon's stream is that of (seed, source, photon): docs/decisions/004. It draws
//   at its start:     its turn around the flow (1), the c-axis it starts in, its polarisation (1);
//   at each boundary: the boundary's orientation (2), the c-axis behind it, the outgoing wave (1).
// A c-axis takes 2 numbers, in a girdle 1, from a Bingham distribution as many as its rejection needs.
#pragma once

#include <cstdint>

#include "propagation/engine/random.h"

namespace floe {

// Uniform in (0, 1), in steps of 2^-32: reflected waves carry 1e-7 of the energy, which the float of
// RandomStream::uniform(), in steps of 2^-23, would round away.
inline double fine_uniform(std::uint32_t bits) {
  return (static_cast<double>(bits) + 0.5) * 0x1p-32;
}
inline double fine_uniform(RandomStream& stream) {
  return fine_uniform(stream.bits());
}

}  // namespace floe

// Random numbers that belong to a photon, not to a thread: the stream is a function of
// (seed, source, photon) alone, so results do not depend on how the work is shared out.
#pragma once

#include <Random123/philox.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace floe {

// xoshiro128++ (Blackman and Vigna 2021), its state drawn with the counter-based Philox4x32-10
// (Salmon et al. 2011) from the photon's coordinates.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t source, std::uint64_t photon) {
    const auto word = [](std::uint64_t value, int shift) { return static_cast<std::uint32_t>(value >> shift); };
    const r123::Philox4x32 philox;
    const auto drawn = philox({{word(photon, 0), word(photon, 32), word(source, 0), word(source, 32)}},
                              {{word(seed, 0), word(seed, 32)}});
    for (int i = 0; i < 4; ++i) state_[i] = drawn[i];
    state_[3] |= 1;  // never all zero
  }

  std::uint32_t bits() {
    const std::uint32_t result = std::rotl(state_[0] + state_[3], 7) + state_[0];
    const std::uint32_t shifted = state_[1] << 9;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 11);
    return result;
  }

  // Uniform in (0, 1): the logarithm of it, and of one minus it, is finite.
  float uniform() { return (static_cast<float>(bits() >> 9) + 0.5f) * 0x1p-23f; }
  float exponential() { return -std::log(uniform()); }

 private:
  std::uint32_t state_[4];
};

}  // namespace floe

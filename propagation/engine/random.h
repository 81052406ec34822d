// Random numbers that belong to a photon, not to a thread: the stream is a function of
// (seed, source, photon) alone, so results do not depend on how the work is shared out.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace floe {

// The state that a photon's stream begins with: four words from Philox4x32-10 (Salmon et al. 2011) for its
// coordinates.
struct PhiloxWords {
  std::uint32_t word0, word1, word2, word3;
};
inline PhiloxWords philox(std::uint64_t seed, std::uint64_t source, std::uint64_t photon) {
  const auto word = [](std::uint64_t value, int shift) { return static_cast<std::uint32_t>(value >> shift); };
  const auto drawn =
      r123::Philox4x32()({{word(photon, 0), word(photon, 32), word(source, 0), word(source, 32)}},
                         {{word(seed, 0), word(seed, 32)}});
  return {drawn[0], drawn[1], drawn[2], drawn[3] | 1};  // never all zero
}

// xoshiro128++ (Blackman and Vigna 2021), its state drawn with the counter-based Philox4x32-10
// (Salmon et al. 2011) from the photon's coordinates.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t source, std::uint64_t photon) {
    const PhiloxWords drawn = philox(seed, source, photon);
    state_ = {drawn.word0, drawn.word1, drawn.word2, drawn.word3};
  }

  // A stream that goes on from the state of another one.
  using State = std::array<std::uint32_t, 4>;
  explicit RandomStream(const State& state) : state_(state) {}
  const State& state() const { return state_; }

  // The interface of a standard uniform random bit generator, for the distributions of <random>.
  using result_type = std::uint32_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() { return bits(); }

  std::uint32_t bits() { return next(state_[0], state_[1], state_[2], state_[3]); }

  float uniform() { return to_uniform(bits()); }
  float exponential() { return -std::log(uniform()); }

  // One step of the generator, on a state that lies anywhere (one lane of many photons).
  static std::uint32_t next(std::uint32_t& s0, std::uint32_t& s1, std::uint32_t& s2, std::uint32_t& s3) {
    const std::uint32_t sum = s0 + s3;
    const std::uint32_t result = ((sum << 7) | (sum >> 25)) + s0;
    const std::uint32_t shifted = s1 << 9;
    s2 ^= s0;
    s3 ^= s1;
    s1 ^= s2;
    s0 ^= s3;
    s2 ^= shifted;
    s3 = (s3 << 11) | (s3 >> 21);
    return result;
  }
  // Uniform in (0, 1): the logarithm of it, and of one minus it, is finite.
  static float to_uniform(std::uint32_t bits) {
    return (static_cast<float>(static_cast<std::int32_t>(bits >> 9)) + 0.5f) * 0x1p-23f;
  }

 private:
  State state_;
};

// The streams of many photons side by side, for loops that become vector code.
struct alignas(64) RandomStreams {
  static constexpr int count = 64;
  std::uint32_t state0[count], state1[count], state2[count], state3[count];

  std::uint32_t bits(int i) { return RandomStream::next(state0[i], state1[i], state2[i], state3[i]); }
  float uniform(int i) { return RandomStream::to_uniform(bits(i)); }

  RandomStream operator[](int i) const { return RandomStream({state0[i], state1[i], state2[i], state3[i]}); }
  void set(int i, const RandomStream& stream) {
    state0[i] = stream.state()[0];
    state1[i] = stream.state()[1];
    state2[i] = stream.state()[2];
    state3[i] = stream.state()[3];
  }
};

}  // namespace floe

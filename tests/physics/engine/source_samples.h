// Moments of what a source emits.
#pragma once

#include <cmath>
#include <cstdint>

#include "propagation/sources/source.h"

namespace floe::test {

inline constexpr int draws = 200000;

struct Sample {
  double mean = 0, variance = 0;
  double error() const { return std::sqrt(variance / draws); }
};
template <typename Function>
Sample sample(const Source& source, Function value) {
  double sum = 0, square = 0;
  for (int i = 0; i < draws; ++i) {
    RandomStream random(1, 0, static_cast<std::uint64_t>(i));
    const double x = value(source.emit(random));
    sum += x;
    square += x * x;
  }
  return {sum / draws, square / draws - sum * sum / draws / draws};
}

}  // namespace floe::test

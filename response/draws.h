// Random numbers of the electronics. Each module of each repeat of each event has a stream of its own, named
// by the event's id: results depend neither on threads nor on what else is in the file.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "propagation/engine/random.h"

namespace floe {

// FNV-1a, 64 bits, of the event's id.
inline std::uint64_t stream_of(std::string_view event) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : event) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

// Gaussian of mean 0 and width 1 (Box and Muller). Two numbers are drawn.
inline double draw_gaussian(RandomStream& stream) {
  const double radius = std::sqrt(2.0 * stream.exponential());
  return radius * std::cos(2 * std::numbers::pi * stream.uniform());
}

// Poisson, by counting exponential steps: for means up to some hundred.
inline int draw_poisson(RandomStream& stream, double mean) {
  int count = 0;
  for (double sum = stream.exponential(); sum < mean; sum += stream.exponential()) ++count;
  return count;
}

}  // namespace floe

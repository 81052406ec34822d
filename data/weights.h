// Sums over weighted photons: what the number of hits is in a weighted simulation (arXiv:1304.0735,
// 1901.04645 use the same two sums).
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "data/event.h"

namespace floe {

// The sum of the weights estimates the number of hits expected, the sum of their squares its variance.
struct WeightSums {
  std::uint64_t hits = 0;
  double sum = 0, squares = 0;

  void add(double weight) {
    ++hits;
    sum += weight;
    squares += weight * weight;
  }
  WeightSums& operator+=(const WeightSums& other) {
    hits += other.hits;
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
  // So many hits of weight 1 would have the same relative error; 0 without hits.
  double effective_hits() const { return squares > 0 ? sum * sum / squares : 0; }
};

// Module by module; the hits' charges are their weights.
using ModuleWeights = std::map<ModuleId, WeightSums>;
inline void add_weights(ModuleWeights& sums, std::span<const Hit> hits) {
  for (const Hit& hit : hits) sums[hit.module].add(hit.charge);
}

}  // namespace floe

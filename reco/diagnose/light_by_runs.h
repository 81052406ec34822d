// How much light simulations have: what those of one run tell wrongly by their noise, those of others set
// right, so that many runs need less of each.
#pragma once

#include <algorithm>
#include <cstddef>

namespace floe {

// For so many runs: `for_six` of them, the same in all of fewer, up to `most`, which is no less.
inline double light_by_runs(std::size_t runs, double for_six, double most) {
  return std::clamp(6 * for_six / static_cast<double>(runs), for_six, most);
}

}  // namespace floe

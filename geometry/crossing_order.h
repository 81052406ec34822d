// What all module finders share: the order of their answers and the range of the oversize.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "data/base/error.h"
#include "geometry/module_scene.h"

namespace floe {

// Sorts the crossings from index `first` on, nearest first, equal distances by module.
inline void sort_crossings(std::vector<ModuleCrossing>& crossings, std::size_t first) {
  if (crossings.size() - first < 2) return;
  std::sort(crossings.begin() + static_cast<std::ptrdiff_t>(first), crossings.end(),
            [](const ModuleCrossing& a, const ModuleCrossing& b) {
              return a.distance != b.distance ? a.distance < b.distance : a.module < b.module;
            });
}

inline void check_oversize(double oversize) {
  if (!(oversize >= 1 && oversize <= 100))
    throw UsageError(fmt::format("oversize: found {}; expected a factor from 1 to 100", oversize));
}

}  // namespace floe

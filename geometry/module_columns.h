// Modules hang in vertical columns: what a string is when its identity does not matter, only its place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/detector.h"

namespace floe {

// Modules above each other: all within `radius` of (x, y) in the horizontal plane [m].
struct ModuleColumn {
  float x, y, radius;
  std::vector<std::pair<float, std::uint32_t>> modules;  // height [m] and index in the detector, rising
};

// Every module is in exactly one column, whose radius is at most 3 m; a leaning string falls into several.
std::vector<ModuleColumn> columns_of(const Detector& detector);

}  // namespace floe

// Events too bright to walk each of their photons.
#pragma once

#include <vector>

#include "apps/planned_light.h"

namespace floe {

inline constexpr double most_photons_by_default = 1e9;

// Of each event that would walk more than `most` photons only a share is simulated, and its hits are an
// average over so many repetitions, fewer than one: a hit counts 1/share. Expected charges stay what they
// are; they scatter more than those of all photons would. Says so on stderr. Throws UsageError when a hit
// would count more than 1e30.
void limit_brightness(double most, std::vector<PlannedEvent>& events);

}  // namespace floe

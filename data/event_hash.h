// A name for what was measured of events.
#pragma once

#include <span>
#include <string>

#include "data/event.h"

namespace floe {

// 32 hexadecimal digits over all that fits read of the events: hits with their charge and width, and the
// readout, in the order in which they stand. Not over the truth, nor wavelengths and directions of hits.
std::string hash_of(std::span<const Event> events);

}  // namespace floe

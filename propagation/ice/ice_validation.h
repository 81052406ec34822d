// Whether tables make physical sense, whatever they come from.
#pragma once

#include "propagation/ice/ice_tables.h"

namespace floe {

// Throws InputError naming the ice, the layer's depth and the quantity when a number is out of its
// range (ice_limits.h), when depths do not rise in uniform steps, or when tables do not fit together.
void validate(const IceTables& tables);

}  // namespace floe

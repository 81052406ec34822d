// Layers that rise along the direction of 1D tilt, each depth by a slope of its own.
#pragma once

#include <functional>

#include "propagation/model_parts.h"

namespace floe {

// Adds slope(depth) [m/km] to the rise of the layers along 225 deg: to the model's map where it has one, to
// its lines where it has those, or to flat layers, which then are what they were at the central string.
void add_rise(const std::function<double(double depth)>& slope, ModelParts& model);

}  // namespace floe

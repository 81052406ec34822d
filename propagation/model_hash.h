// A name for all that a model makes of a source.
#pragma once

#include <string>

#include "propagation/model.h"

namespace floe {

// 32 hexadecimal digits over the ice (ice_hash.h), the detector, how modules accept light, how sources differ
// from what is said of them, and dark noise. Models of one name give the same light.
std::string model_hash(const Model& model);

}  // namespace floe

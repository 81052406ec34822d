// What users should know of the model that they simulate with.
#pragma once

#include <string>
#include <vector>

#include "propagation/model.h"

namespace floe {

// Says on stderr what simulations of this model, with modules so wide, cannot do; returns the same for JSON
// outputs. Once a command.
std::vector<std::string> warn_of_model(const Model& model, double oversize);

}  // namespace floe

// What output files say of the model they were made with.
#pragma once

#include "apps/common_options.h"
#include "apps/planned_output.h"
#include "data/event.h"
#include "propagation/model.h"

namespace floe {

// The model options as they were given.
Json to_json(const ModelRequest& request);
// Names and hashes of ice and detector.
Json to_json(const Model& model);

}  // namespace floe

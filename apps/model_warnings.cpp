#include "apps/model_warnings.h"

#include <fmt/format.h>

#include "propagation/engine/simulator.h"

namespace floe {

std::vector<std::string> warn_of_model(const Model& model, double oversize) {
  std::vector<std::string> warnings = simulation_warnings(model, oversize);
  for (const std::string& warning : warnings) fmt::print(stderr, "floe: warning: {}\n", warning);
  return warnings;
}

}  // namespace floe

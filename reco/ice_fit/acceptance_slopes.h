// How counts depend on what modules accept: exact, from each hit's module and direction.
#pragma once

#include <optional>
#include <vector>

#include "propagation/engine/simulator.h"
#include "propagation/model.h"

namespace floe {

class AcceptanceChange {
 public:
  // None when the models differ in more than how modules accept light: ice, places of modules, sources.
  static std::optional<AcceptanceChange> between(const Model& was, const Model& is);

  // Logarithm of how many such hits there are in `is` for one in `was`.
  double ln_ratio(const SimulatedHit& hit) const;

 private:
  AcceptanceChange(const Model& was, const Model& is);

  std::shared_ptr<const Detector> detector_;
  AngularAcceptance was_, is_;
  std::vector<double> efficiency_;  // by module: ln(ratio)
};

}  // namespace floe

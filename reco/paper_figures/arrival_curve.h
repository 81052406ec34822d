// When the light of a flasher arrives on some modules.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

// Bins that grow with the time since the first light could have come: late light is thin.
std::vector<double> arrival_edges(double distance);  // [ns]; distance [m]

struct ArrivalCurve {
  std::vector<double> charge;            // per bin [photoelectrons]
  std::vector<double> variance;          // of the charge
  double total = 0, total_variance = 0;  // at all times
  double median = 0;                     // time before which half of the charge has come [ns]
  double median_error = 0;               // from the number of hits
};

ArrivalCurve arrival_curve(std::span<const SimulatedHit> hits, std::span<const std::uint32_t> modules,
                           std::span<const double> edges);

}  // namespace floe

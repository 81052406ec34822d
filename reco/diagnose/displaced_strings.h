// What a run's light would be if strings hung elsewhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "propagation/model.h"
#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// Slopes of ln(light) per bin in the displacement of all strings but the flasher's own along x, y and z
// [1/m]; from even and from odd photons.
struct DisplacedStrings {
  std::array<Eigen::MatrixXd, 2> fold;  // bins x 3
  std::array<Eigen::MatrixXd, 2> raw;   // the same, as simulated: right on average, but noisy
  std::uint64_t propagated = 0;
};

// `light`: of the run where the strings are; simulations of `share` times its light, with the same random
// numbers.
DisplacedStrings displaced_strings(const Model& model, const RunRequest& request, const RunBins& bins,
                                   double time_zero, const RunLight& light, double share);

}  // namespace floe

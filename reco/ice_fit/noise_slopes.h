// How a flasher run's light depends on the rate of its modules' noise, of which no simulation is needed.
#pragma once

#include <Eigen/Core>

#include "propagation/engine/noise_hits.h"
#include "reco/ice_fit/run_bins.h"

namespace floe {

// Expected noise hits of each bin at a rate of 1 Hz.
Eigen::VectorXd noise_of_bins(const RunBins& bins, const NoiseWindow& window);

}  // namespace floe

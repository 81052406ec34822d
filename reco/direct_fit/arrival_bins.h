// Time bins that follow the expected light instead of the data.
#pragma once

#include <span>
#include <vector>

#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/local_frame.h"
#include "reco/event_data.h"

namespace floe {

// Inner edges [ns] for every module of data.lit(): quantiles of the arrival times in the simulations, narrow
// early, where light rises steeply, and the more the brighter the module is expected to be (4 to 16 bins).
// Modules with few simulated hits take the quantiles of modules at similar distances and angles. Bins that
// follow the data's own fluctuations (Bayesian blocks) bias times; these cannot. Modules expected to see less
// than `least_expected` [photoelectrons] have no edges: among dim modules those of lit() are a choice that
// the data made, which a test of goodness must not see.
std::vector<std::vector<double>> arrival_edges(const EventData& data, const LocalFrame& frame,
                                               std::span<const LightSample* const> samples, CascadeKind kind,
                                               double least_expected = 0);

}  // namespace floe

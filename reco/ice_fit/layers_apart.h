// Layer by layer, as SpiceBFR was made (arXiv:2107.08692): each layer is fitted to its own flashers alone.
#pragma once

#include "reco/ice_fit/ice_fit.h"

namespace floe {

// For every group of depth the parameters of all families there, fitted to the runs whose flasher lies in the
// group, all others at their start. Quick, and blind to what a layer's neighbours do to its light. Groups
// without a flasher are not in the result. Throws UsageError for parameters that belong to no depth, and
// NoResult when no group has a flasher.
IceFit fit_layers_apart(const Model& base, const FlasherData& data,
                        const std::vector<IceParameter>& parameters, const IceFitOptions& options,
                        const Progress& progress = {});

}  // namespace floe

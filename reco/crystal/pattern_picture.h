// A picture of diffusion patterns: photons on the sphere, and deflection and widths against the angle.
#pragma once

#include <string>

#include "reco/crystal/crystal_study.h"

namespace floe {

// SVG text. On the sphere the photons of every third angle or so, each pattern around its first direction,
// seen from 45 deg to the flow; beside it m_x, sigma_x and sigma_y with their errors, the fitted functions
// and those of SpiceBFR v2. `estimator`: which values are drawn.
std::string pattern_picture(const CrystalStudy& study, PatternEstimator estimator);

}  // namespace floe

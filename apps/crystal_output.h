// What floe crystal prints and writes of the kinds of ice it has looked at.
#pragma once

#include <span>
#include <string>

#include "apps/planned_output.h"
#include "reco/crystal/crystal_study.h"

namespace floe {

// Patterns by angle, the 12 numbers beside SpiceBFR v2's, and how patterns scale.
std::string crystal_tables(const CrystalStudy& study);
// The 12 numbers of many kinds of ice, one a row.
std::string crystal_library(std::span<const CrystalStudy> studies, PatternEstimator estimator);

Json to_json(const CrystalStudy& study);

}  // namespace floe

// What a model is made of, before it is checked and frozen.
#pragma once

#include "geometry/acceptance.h"
#include "geometry/detector.h"
#include "propagation/ice/ice_tables.h"
#include "propagation/sources/source_settings.h"

namespace floe {

struct ModelParts {
  IceTables ice;
  Detector detector;
  ModuleAcceptance acceptance = {};
  SourceSettings sources = {};
  double noise_rate = 0;  // of every module [Hz]
};

}  // namespace floe

// An ice model and its detector in words: a label and a text a line.
#pragma once

#include <string>
#include <vector>

#include "propagation/model.h"

namespace floe {

struct SummaryLine {
  std::string label, text;
};

// `idealised`: built in, and to be called so.
std::vector<SummaryLine> ice_lines(const IceModel& ice, bool idealised);
std::vector<SummaryLine> detector_lines(const Model& model, bool idealised);

struct DetectorCounts {
  long on = 0;       // modules switched on
  long high_qe = 0;  // with a spectrum of their own, or more than 1.2 times as efficient as a nominal one
  long cables = 0;   // modules with a known cable
  long tilted = 0;   // modules whose axis is not vertical
};
DetectorCounts count_modules(const Detector& detector);

// Depth of a layer's centre where the ice is not tilted [m].
double layer_depth(const IceModel& ice, int layer);

}  // namespace floe

// Where simulation and data disagree: along each of several axes, the region that sticks out the most.
#pragma once

#include <string>
#include <vector>

#include "reco/diagnose/axes.h"
#include "reco/diagnose/survey.h"

namespace floe {

// Light along one axis, in the survey's cells of it.
struct ResidualProfile : AxisCells {
  std::vector<double> relative, error;  // counts above the expectation, as a share of it
};

struct Region {
  std::string axis;
  double from = 0, to = 0;
  std::string name = {};    // of a string or module, "36" or "36,20", where there is no range
  int sign = 0;             // +1: the data have more light than the model
  double relative = 0;      // by that share
  double significance = 0;  // standard deviations, corrected for the places looked at on this axis
  // "The data have 12.1% less light than the model towards 105-165 deg and opposite." That of the first
  // region says how the gap there goes with distance and time, too: ", growing with distance, timing
  // unchanged."
  std::string sentence;
};

struct Whereabouts {
  std::vector<ResidualProfile> profiles;
  std::vector<Region> regions;  // one an axis that has light enough anywhere, the most significant first
};

// `axes`: of the survey. Significances are calibrated with `draws`.
Whereabouts where_is_the_gap(const Survey& survey, const std::vector<Axis>& axes, const Draws& draws);

}  // namespace floe

// A picture of data and fits: arrival times of the brightest modules.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reco/direct_fit/cascade_fit.h"

namespace floe {

struct FigureFit {
  std::string label;      // in the legend, e.g. the ice model's name
  const CascadeFit* fit;  // not null
};

// SVG text: up to `modules` panels (the brightest of the first fit), data as a histogram with Poisson
// errors, every fit as a line. Write it with write_whole_file. UsageError without fits or light.
std::string figure_arrival_times(std::span<const FigureFit> fits, const std::string& title, int modules = 6);

}  // namespace floe

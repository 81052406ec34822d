// What `floe reconstruct --json` and `floe compare --json` said of an event.
#pragma once

#include <string>
#include <vector>

#include "apps/planned_output.h"

namespace floe {

struct FittedCascade {
  std::string label;  // "fit", or "A" and "B" of a comparison
  double x, y, z, time, zenith_deg, azimuth_deg, energy;
  Json errors;  // standard deviations in that order; empty when they are not known
};

struct FitResults {
  std::string status;  // "ok", or why there is no fit
  std::vector<FittedCascade> fits;
};

// Of the event in the file `events`: where several files were fitted together, results say whose they are.
// Throws InputError: no such file, not JSON, not of this kind, or without the event.
FitResults read_fit_results(const std::string& file, const std::string& events, const std::string& event);

}  // namespace floe

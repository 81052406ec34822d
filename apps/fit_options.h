// Options and output of the commands that fit cascades.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "apps/common_options.h"
#include "apps/planned_output.h"
#include "reco/direct_fit/cascade_fit.h"

namespace floe {

struct FitSettings {
  SimulationSettings simulation;
  std::string hypothesis = "em";
  double model_error = 0.1;
  double noise_rate = 0;  // [1/s]
  double effort = 1;
};

// --hypothesis, --model-error, --noise-rate, --effort, and those of every simulation.
void add_fit_options(CLI::App& app, FitSettings& settings);
FitOptions to_fit_options(const FitSettings& settings);  // throws UsageError

// The fit as files have it: metres, nanoseconds, degrees, GeV. Values are null where nothing was fitted.
Json fit_json(const CascadeFit& fit);

}  // namespace floe

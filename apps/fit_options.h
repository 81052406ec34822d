// Options and output of the commands that fit cascades.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common_options.h"
#include "apps/planned_output.h"
#include "reco/direct_fit/cascade_fit.h"

namespace floe {

struct FitSettings {
  SimulationSettings simulation;
  std::string hypothesis = "em";
  double model_error = 0.1;
  double effort = 1;
  // Of the data: modules and times left out, dark noise, saturation.
  std::vector<std::string> bad, left_out;
  std::optional<std::string> noise_file;
  double noise_rate = 0;
  std::optional<double> charge_cap;
};

// --hypothesis, --model-error, --effort, --bad, --leave-out, --noise-rate, --noise, --charge-cap, and those
// of every simulation.
void add_fit_options(CLI::App& app, FitSettings& settings);
FitOptions to_fit_options(const FitSettings& settings);  // throws UsageError, InputError
// All that results depend on: not the number of threads.
Json to_json(const FitOptions& options);

// "STRING,DOM[;STRING,DOM...]", or the name of a file with STRING DOM on a line.
std::vector<ModuleId> parse_modules(const std::string& option, const std::string& text);
// "BEGIN,END" [ns] of all modules, or "STRING,DOM:BEGIN,END" of one.
TimeWindow parse_window(const std::string& option, const std::string& text);

// The fit as files have it: metres, nanoseconds, degrees, GeV. Values are null where nothing was fitted or,
// in "profile", where the interval does not end; "sky_map" and "profile" are there when the fit has them.
Json fit_json(const CascadeFit& fit);

}  // namespace floe

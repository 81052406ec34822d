// What floe fit-ice leaves behind: a folder with the new ice model, the fit's numbers and its stratigraphy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/planned_output.h"
#include "propagation/model.h"
#include "reco/ice_fit/ice_fit.h"

namespace floe {

// Everything there is to tell about a fit.
struct IceFitReport {
  ModelRequest base_request;
  Model base, fitted;
  IceFit fit;
  std::string command, data;
  IceFitOptions options;
};

std::string ice_fit_table(const IceFitReport& report);  // for people
Json ice_fit_json(const IceFitReport& report);          // result.json
Json to_json(const RunResult& run);
// result.json, stratigraphy.csv, stratigraphy.svg, efficiencies.csv where they were fitted, and improved-ice/
// with its CHANGES.txt, where copy_base_ice has been. Throws OutputError.
void write_ice_fit(const IceFitReport& report, const std::filesystem::path& folder);

}  // namespace floe

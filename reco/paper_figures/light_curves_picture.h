// Arrival times on strings along the flow and across it, in several models.
#pragma once

#include <string>
#include <vector>

#include "reco/paper_figures/arrival_curve.h"

namespace floe {

struct CurvePanel {
  std::string title;                 // "along the flow: string 62, 125 m"
  std::string key;                   // "along"
  std::vector<double> edges;         // [ns]
  std::vector<ArrivalCurve> curves;  // by model
};

struct LightCurves {
  double photons = 0;               // N of each simulation
  std::vector<std::string> models;  // their names
  std::vector<CurvePanel> panels;
};

// Charge per time for the same N, in 1e9.
std::string light_curves_csv(const LightCurves& curves);
std::string light_curves_picture(const LightCurves& curves, const std::string& title);

}  // namespace floe

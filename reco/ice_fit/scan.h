// Likelihood landscapes: -ln L of flasher data over two numbers of the ice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/model.h"
#include "reco/figures/contours.h"
#include "reco/ice_fit/ice_fit.h"
#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/quadratic_minimum.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

// Evenly spaced values, as they are shown: factors, not their logarithms.
struct ScanAxis {
  IceParameter parameter;
  double low = 0, high = 0;
  int count = 3;  // of values, 3 at least

  double step() const { return (high - low) / (count - 1); }
  std::vector<double> values() const;
  double base() const;                // its value in the base model
  double number(double value) const;  // as IceParameter::apply takes it
};

struct IceScan {
  ScanAxis x, y;
  NumberGrid neg_llh;  // rows along y, columns along x; each run's brightness and time zero at their best
  QuadraticMinimum minimum;
  // Standard deviation, from the simulation, of the difference of -ln L between two of the points about the
  // minimum: from even and odd photons.
  double noise = 0;
  std::vector<RunResult> runs;        // at the lowest point
  std::vector<std::string> left_out;  // of the data, a sentence each
  int bins = 0;
  std::uint64_t photons = 0;  // propagated
  double seconds = 0;
};

// Levels of -ln L above its minimum whose regions hold 68% and 95% for two numbers (-ln L is not doubled).
inline constexpr double level_68 = 1.15, level_95 = 3.09;

// Simulates every run at every point, with the same random numbers everywhere, so that differences between
// points have little noise; bins are those of the base model's light. Throws UsageError for options or axes
// out of range and for the same parameter twice, NoResult when no run has light to compare.
IceScan scan_ice(const Model& base, const FlasherData& data, const ScanAxis& x, const ScanAxis& y,
                 const RunSettings& options, const Progress& progress = {});

// Grid as a colour map, contours at both levels, minimum, base model: an SVG document.
std::string scan_picture(const IceScan& scan, const std::string& title);

}  // namespace floe

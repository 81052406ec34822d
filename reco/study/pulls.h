// Whether errors are as large as they say.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

// The central share of a Gaussian within one standard deviation.
constexpr double central_share = 0.6827;

// Of pulls, (fit - truth) / error. Not a number where there are too few values for it.
struct PullSummary {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double mean = unknown;
  // The width is the standard deviation, the core half of the interval that holds the central 68.27%; both
  // are 1 for Gaussian errors, and a few events far off widen only the first. The core needs six values.
  double width = unknown, width_error = unknown;
  double core = unknown, core_error = unknown;
  double coverage = unknown, coverage_error = unknown;  // share of pulls within 1
};

// Of independent pulls; errors are those of Gaussian and binomial numbers.
PullSummary summary_of(std::span<const double> pulls);

// Of all seven pulls of each event taken together. These depend on each other, so that errors come from
// events drawn again with replacement (bootstrap, Efron 1979), always with the same random numbers.
PullSummary summary_of(std::span<const Vector7> pulls_of_events);

double mean_of(std::span<const double> values);             // not a number of none
double standard_deviation(std::span<const double> values);  // not a number of fewer than two
double binomial_error(double count);                        // of the central share

}  // namespace floe

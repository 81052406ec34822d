// What a calibration study says: tables of bias, errors, pulls and coverage.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "reco/study/pulls.h"
#include "reco/study/study.h"

namespace floe {

// Differences of one fit from the truth, in the numbers that a study judges: x, y, z [m], time [ns],
// direction along rising zenith and along rising azimuth (angles on the sphere [rad]), and energy (relative).
struct StudyResiduals {
  Vector7 difference;  // fit - truth
  Matrix7 covariance;  // the fit's
  Matrix7 bound;       // Cramer-Rao
  Vector7 pulls() const { return difference.cwiseQuotient(covariance.diagonal().cwiseSqrt()); }
};
StudyResiduals residuals_of(const StudyRow& row, const StudyFit& fit);

// Whether a study has numbers to judge: the fit ended, with errors. Table, picture and bias judge the same.
bool is_fitted(const StudyFit& fit);

// Of an even number of values, the middle between the two; not a number of none.
double median(std::vector<double> values);

// One parameter, or several taken together, over a number of events.
struct StudyLine {
  std::string name, unit;
  std::size_t count = 0;  // of values: events, or events x parameters when pooled
  // Not a number where there are too few values for it.
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double bias = unknown, bias_error = unknown;  // mean and its error
  double median_error = unknown;                // of |fit - truth|
  // What Gaussian errors at each event's Cramer-Rao bound would give for it, and how far the median of so
  // many events would scatter about that.
  double median_bound = unknown, median_scatter = unknown;
  // Of a length (position, direction) only the coverage: of the joint region for 68.27%.
  PullSummary pull;
};

struct StudyTable {
  std::string title;
  std::size_t events = 0, fitted = 0;
  std::size_t contested = 0;  // of the fitted: another minimum competed
  // x, y, z, time, zenith, azimuth, energy; then position and direction (distances, with regions of three and
  // two dimensions) and all seven parameters pooled.
  std::vector<StudyLine> lines;
  std::vector<std::string> failures;  // event: status: reason
};

// Over all rows, or those of one energy.
StudyTable summarise(std::span<const StudyRow> rows, const std::string& title);

std::string text_of(const StudyTable& table);

// SVG: pulls of all parameters against a Gaussian, and errors against what the bound allows.
std::string figure_of_study(std::span<const StudyRow> rows, const std::string& title);

}  // namespace floe

// What fits with another model than the true one get wrong, and how much worse it describes the data.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "reco/study/study.h"

namespace floe {

// Differences from the truth in units of the fits' own errors, squared and summed over events: chi-square
// where fits and errors are right.
struct StudyChiSquare {
  double value = 0;
  std::size_t degrees = 0;
  double probability() const;  // of a larger one by chance
};

// Fits with one model.
struct ModelBias {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double median_angle = unknown;                                      // from the truth [rad]
  double mean_log_energy = unknown, mean_log_energy_error = unknown;  // ln(fit/truth); error from its scatter
  StudyChiSquare direction, energy, all;                              // 2, 1 and 7 degrees an event
};

// Over the events for which both fits have a result.
struct StudyBias {
  std::size_t events = 0;
  ModelBias other, truth;
  // Of -ln L, other - truth: the mean of an event, its error from the scatter of events (which differ), and
  // the sum, its error from the simulations'.
  double mean_delta = 0, mean_delta_error = 0;
  double sum_delta = 0, sum_delta_error = 0;
  double least_significance = 0,
         median_significance = 0;  // of an event's, in units of its simulations' error
};
StudyBias summarise_bias(std::span<const StudyRow> rows);

std::string text_of(const StudyBias& bias);

}  // namespace floe

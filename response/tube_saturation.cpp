#include "response/tube_saturation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace floe {

namespace {

constexpr double elementary_charge = 1.602176634e-19;  // [C]
// Compression that nobody sees: modules whose whole charge, if it came at once, lost less are passed over.
constexpr double negligible = 1e-3;
constexpr double reach = 4;  // of the pulse, in its widths

double current_of_charge(const TubeSettings& tube) {  // of one photoelectron, times ns [mA ns]
  return tube.gain * elementary_charge * 1e12;
}

// Current over the ideal one.
double compression(const TubeSettings& tube, double ideal) {
  return ideal > 0 ? compressed_current(tube, ideal) / ideal : 1;
}

}  // namespace

double compressed_current(const TubeSettings& tube, double ideal) {
  if (ideal <= 0) return 0;
  // The right side of the equation rises with x = I/A from -infinity to infinity in (0, 1).
  const double wanted = std::log(ideal / tube.largest_current);
  double low = 0, high = std::min(1.0, ideal / tube.largest_current);
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    const double value = std::log(x) + tube.factor * std::pow(x, tube.exponent) / std::pow(1 - x, 0.25);
    (value < wanted ? low : high) = x;
  }
  return tube.largest_current * 0.5 * (low + high);
}

double charge_in_millivolt(const TubeSettings& tube) {
  return current_of_charge(tube) * tube.impedance;
}

std::vector<TimeRange> saturate(const TubeSettings& tube, std::vector<Photoelectron>& photoelectrons) {
  const double charge = std::accumulate(photoelectrons.begin(), photoelectrons.end(), 0.0,
                                        [](double sum, const auto& pe) { return sum + pe.charge; });
  const double peak = current_of_charge(tube) / (tube.pulse_width * std::sqrt(2 * std::numbers::pi));
  if (compression(tube, charge * peak) > 1 - negligible) return {};

  std::vector<TimeRange> saturated;
  std::vector<float> reduced(photoelectrons.size());
  std::size_t first = 0;  // of those near enough
  double last_time = -std::numeric_limits<double>::infinity(), ratio = 1;
  for (std::size_t i = 0; i < photoelectrons.size(); ++i) {
    const double time = photoelectrons[i].time;
    if (time - last_time > 0.05 * tube.pulse_width) {  // else the current is that of the one before
      while (photoelectrons[first].time < time - reach * tube.pulse_width) ++first;
      double current = 0;
      for (std::size_t k = first;
           k < photoelectrons.size() && photoelectrons[k].time < time + reach * tube.pulse_width; ++k) {
        const double z = (photoelectrons[k].time - time) / tube.pulse_width;
        current += photoelectrons[k].charge * peak * std::exp(-0.5 * z * z);
      }
      ratio = compression(tube, current);
      last_time = time;
    }
    reduced[i] = static_cast<float>(photoelectrons[i].charge * ratio);
    if (ratio > 1 - tube.saturated_share) continue;
    const TimeRange here{time - tube.pulse_width, time + tube.pulse_width};
    if (!saturated.empty() && here.begin <= saturated.back().end)
      saturated.back().end = here.end;
    else
      saturated.push_back(here);
  }
  for (std::size_t i = 0; i < reduced.size(); ++i) photoelectrons[i].charge = reduced[i];
  return saturated;
}

}  // namespace floe

#include "reco/direct_fit/calibration_stages.h"

#include <algorithm>
#include <limits>

namespace floe {
namespace {

constexpr double notable_share = 0.02;                          // of all charge, for a module to limit steps
constexpr double step_share = 0.3;                              // of the way to it
constexpr double least_widest_step = 2, most_widest_step = 10;  // [m]
// Weights need not be exact, and are less noisy from a wide region.
constexpr double least_training_step = 5;  // [m]
constexpr double least_training_turn = 8 * degree, most_training_turn = 18 * degree;
constexpr double least_step = 0.3, most_step = 5;  // of the narrow design [m]
constexpr double least_turn = 0.5 * degree, most_turn = 10 * degree;

}  // namespace

double widest_step(const EventData& data, const LightCentre& light) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ModuleData& lit : data.lit())
    if (lit.charge > notable_share * data.charge())
      nearest = std::min(nearest, (data.detector().modules()[lit.module].position - light.position).norm());
  return std::clamp(step_share * nearest, least_widest_step, most_widest_step);
}

CalibrationStages calibration_stages(double position_error, double direction_error, double widest_step,
                                     double oversize) {
  return {
      {std::clamp(2 * position_error, std::min(least_training_step, widest_step), widest_step),
       std::clamp(2 * direction_error, least_training_turn, most_training_turn), training_oversize(oversize)},
      {std::clamp(position_error, least_step, most_step), std::clamp(direction_error, least_turn, most_turn),
       oversize}};
}

}  // namespace floe

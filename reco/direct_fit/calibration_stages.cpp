#include "reco/direct_fit/calibration_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/base/constants.h"

namespace floe {
namespace {

constexpr double notable_share = 0.02;  // of all charge, for a module to limit steps
constexpr double direct_way = 15;       // light is hardly scattered [m]
constexpr double step_share = 0.3;      // of the way to it
constexpr double least_widest_step = 0.4, most_widest_step = 10;  // [m]
// Weights need not be exact, and are less noisy from a wide region.
constexpr double least_training_step = 5;  // [m]
constexpr double least_training_turn = 8 * degree, most_training_turn = 12 * degree;
constexpr double least_step = 0.2, most_step = 3;  // of the narrow design [m]
constexpr double least_turn = 0.5 * degree, most_turn = 6 * degree;
constexpr double oversize_unit = 5;  // simulations of the same oversize can be used again

// To the nearest module that sees much [m].
double nearest_way(const EventData& data, const LightCentre& light) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ModuleData& lit : data.lit())
    if (lit.charge > notable_share * data.charge())
      nearest = std::min(nearest, (data.detector().modules()[lit.module].position - light.position).norm());
  return nearest;
}

}  // namespace

double widest_step(const EventData& data, const LightCentre& light) {
  const double way = nearest_way(data, light);
  return std::clamp(step_share * way * std::min(1.0, way / direct_way), least_widest_step, most_widest_step);
}

double training_oversize(const EventData& data, const LightCentre& light, double oversize) {
  const double radius = step_share * nearest_way(data, light);
  const double most = oversize_unit * std::floor(radius / module_radius / oversize_unit);
  return std::max(oversize, std::min(training_oversize(oversize), most));
}

double rough_oversize(const EventData& data, const LightCentre& light, double oversize) {
  constexpr double too_wide = 0.5;  // radius, in units of the way there
  const double usual = training_oversize(oversize);
  return usual * module_radius > too_wide * nearest_way(data, light)
             ? training_oversize(data, light, oversize)
             : usual;
}

PlaceErrors place_errors(const Matrix7& covariance) {
  return {std::sqrt(covariance.topLeftCorner<3, 3>().trace()),
          std::sqrt(covariance.block<2, 2>(3, 3).trace())};
}

CalibrationStages calibration_stages(const EventData& data, const LightCentre& light,
                                     const PlaceErrors& errors, double reach, double oversize) {
  const double widest = widest_step(data, light);
  return {{reach * std::clamp(2 * errors.position, std::min(least_training_step, widest), widest),
           reach * std::clamp(2 * errors.direction, least_training_turn, most_training_turn),
           training_oversize(data, light, oversize)},
          {reach * std::clamp(errors.position, least_step, std::min(most_step, widest)),
           reach * std::clamp(errors.direction, least_turn, most_turn), oversize}};
}

}  // namespace floe

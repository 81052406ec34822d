// How light changes when something is wrong with one string or one module.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/detector.h"
#include "reco/diagnose/survey.h"

namespace floe {

// Strings and modules with less light, in counts of the data, are not looked at one by one.
inline constexpr double light_of_string = 300, light_of_module = 150;

// Efficiency, clock and place of every string, and efficiency of every module, that sees enough light in all
// runs together.
std::vector<SurveyColumn> place_columns(const std::vector<SurveyRun>& runs, const Detector& detector);

// Slopes of ln(light) in a run's bins, of one fold.
struct PlaceSlopes {
  Eigen::MatrixXd displacement;  // bins x 3: all strings but the flasher's own moved along x, y, z [1/m]
  Eigen::VectorXd delay;         // all modules' times [1/ns]
};

// The slope of one place: nothing in the bins of all others.
Eigen::VectorXd place_slope(const SurveyColumn& column, const SurveyRun& run, const PlaceSlopes& slopes,
                            const Detector& detector);

// Whether it moves a string.
bool is_displacement(SurveyColumn::Kind kind);

}  // namespace floe

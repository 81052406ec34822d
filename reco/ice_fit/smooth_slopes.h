// What noisy slopes of a flasher run's light probably are: smooth where the light is smooth.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/detector.h"
#include "reco/ice_fit/run_bins.h"

namespace floe {

struct LightFold;

// Where a run's bins lie, bins x terms: products of the distance from the flasher, of how much of the way is
// along and across the flow, and of how late the bin is in its receiver's light; first those that are alike
// forwards and backwards, left and right, up and down. The first column is 1.
Eigen::MatrixXd bin_places(const RunBins& bins, const Detector& detector, const Vec3& flasher,
                           double flow_azimuth);

// Slopes of ln(counts) per bin and parameter, one matrix for each fold, from that fold's own scores: a smooth
// function of the place, proportional to how long light dwells where the parameter acts, plus what both folds
// agree on beyond it. Both parts are shrunk as their noise demands (James and Stein): on average the true
// slope is what the smooth one says.
struct SmoothSlopes {
  Eigen::MatrixXd fold[2];
};
// `symmetric`: by parameter, whether its effect has that symmetry; of one that has not, bins without dwell
// have no slope, and what others have is smooth among themselves.
SmoothSlopes smooth_slopes(const LightFold (&folds)[2], const Eigen::MatrixXd& places,
                           const std::vector<char>& symmetric);

}  // namespace floe

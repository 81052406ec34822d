// The maximum of the likelihood of one emulator, with Ceres.
#pragma once

#include <memory>

#include <ceres/cost_function.h>

#include "reco/direct_fit/emulator.h"

namespace floe {

struct LocalFit {
  Vector7 step = Vector7::Zero();         // from the emulator's origin
  Matrix7 information = Matrix7::Zero();  // at the maximum
  double neg_llh = 0;
  bool converged = false;  // by Ceres' measure
};

// Ceres' cost: a residual for each bin, the signed root of twice its negative log-likelihood, so that
// half the sum of squares is -ln L and Gauss-Newton steps are good ones. One parameter block of 7.
std::unique_ptr<ceres::CostFunction> make_cost(const Emulator& emulator);

// Largest change of the parameters that an emulator is trusted with.
Vector7 trust_region(const EmulatorSettings& settings);

// Inverse of the information; infinite where it says nothing about a combination of the parameters.
Matrix7 covariance_of(const Matrix7& information);

LocalFit fit_locally(const Emulator& emulator);

}  // namespace floe

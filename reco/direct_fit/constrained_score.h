// The lowest -ln L where some of a cascade's parameters are given: of this, profile likelihoods are made.
#pragma once

#include <functional>
#include <optional>

#include "reco/direct_fit/score_likelihood.h"

namespace floe {

// A surface in the space of local numbers, as m < 7 functions that vanish on it, at some p: what they are
// there, in units of about an error, and how they change. Values that are not finite: p is nowhere near.
struct SurfaceDistance {
  Eigen::VectorXd value;                           // m
  Eigen::Matrix<double, Eigen::Dynamic, 7> slope;  // m x 7: d value / d p
};
using Surface = std::function<SurfaceDistance(const Vector7& p)>;

struct LowestPoint {
  Vector7 p;           // local numbers
  double neg_llh = 0;  // -ln L above the solution's, >= 0
};

// The minimum on the surface, by Gauss-Newton steps along it from the point that is likeliest when `start`
// is: in a Gaussian likelihood that is the conditional mean, and the minimum at once. -ln L is within 1e-4 of
// the minimum, as far as the sums are smooth. Nothing when the way there leaves what is trusted, or when
// there is no such surface near.
std::optional<LowestPoint> lowest_on(const Surface& surface, const Vector7& start,
                                     const ScoreLikelihood& likelihood);

}  // namespace floe

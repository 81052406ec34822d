// Two minima that the data hardly tell apart, as cascades mirrored about a string are.
#pragma once

#include <string>

#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

// A minimum elsewhere: larger in -ln L by so much, from equal simulations of both.
struct OtherMinimum {
  CascadeParameters cascade;
  double delta_neg_llh = 0, delta_neg_llh_error = 0;
};

// The odds that the truth is there rather than at the best minimum, 0 to 0.5: exp(-delta) against 1, with
// the error of delta averaged over (MacKay 1992, Neural Computation 4, 720, eq. 10).
double share_of(const OtherMinimum& other);

// Mean square of (truth - best) when the truth is at either of the two, each with the errors of the best.
Matrix7 with_other_minimum(const Matrix7& covariance, const CascadeParameters& best,
                           const OtherMinimum& other);

// A line for people.
std::string describe(const OtherMinimum& other);

}  // namespace floe

// Two minima that the data hardly tell apart, as cascades mirrored about a string are.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

// A minimum elsewhere: larger in -ln L by so much, from equal simulations of both.
struct OtherMinimum {
  CascadeParameters cascade;
  double delta_neg_llh = 0, delta_neg_llh_error = 0;
};

// In -ln L: ends that are not so much worse than the best compete with it.
inline constexpr double competing_neg_llh = 3;

// Whether it is hardly worse than the best, as far as that is known.
bool competes(const OtherMinimum& other);

// Where a search ended, beside the best.
struct OtherEnd {
  CascadeParameters cascade;
  double worse = 0, error = 0;  // than the best, in -ln L from equal simulations
  bool unsolved = false;        // not brought to its minimum, while the best was
};
// The one of them that competes with the best and is the least worse, if any does. An unsolved one counts as
// what it would be at its minimum.
std::optional<OtherMinimum> competing_minimum(std::span<const OtherEnd> ends);

// The odds that the truth is there rather than at the best minimum, 0 to 0.5: exp(-delta) against 1, with
// the error of delta averaged over (MacKay 1992, Neural Computation 4, 720, eq. 10).
double share_of(const OtherMinimum& other);

// Mean square of (truth - best) when the truth is at either of the two, each with the errors of the best.
Matrix7 with_other_minimum(const Matrix7& covariance, const CascadeParameters& best,
                           const OtherMinimum& other);

// A line for people.
std::string describe(const OtherMinimum& other);

}  // namespace floe

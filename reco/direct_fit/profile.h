// Errors from the profile likelihood, which need not be the same on both sides.
#pragma once

#include <array>
#include <string>

#include "reco/direct_fit/score_likelihood.h"

namespace floe {

// Where the lowest -ln L at a given value of the parameter is 1/2 above the solution's: 68.27% when that is a
// parabola in some function of the parameter. NaN where the sums are trusted no further, or where the
// parameter ends (zenith 0 and pi, energy 0, half a turn of azimuth).
struct ProfileInterval {
  double low, high;
};

// Of x, y, z [m], time [ns], zenith, azimuth [rad], energy [GeV]. Azimuths are not brought back to one turn:
// low < solution < high.
using ProfileIntervals = std::array<ProfileInterval, 7>;

// Takes about 100 evaluations of the likelihood.
ProfileIntervals profile_intervals(const ScoreLikelihood& likelihood, CascadeKind kind);

// A line each parameter, angles in degrees, for people.
std::string describe(const ProfileIntervals& intervals);

}  // namespace floe

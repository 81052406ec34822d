// The mean of places that a search went through. Where noise keeps the steps of a search from ending, it
// walks about the solution, and the mean of its places is as good an estimate as any (Polyak and Juditsky
// 1992, SIAM Journal on Control and Optimization 30, 838).
#pragma once

#include <span>

#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

struct AveragePlace {
  LightCentre light;
  Matrix7 scatter;  // covariance of the places about it, in the local numbers around it (LocalFrame)
};

// Of two places or more, close enough together for one tangent plane of directions.
AveragePlace average_of(std::span<const LightCentre> places);

}  // namespace floe

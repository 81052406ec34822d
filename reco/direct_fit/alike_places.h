// Where else about the only string with light the truth may be: the likelihood is flat there and not a
// Gaussian, so that the errors of the best place do not speak of it.
#pragma once

#include <optional>
#include <vector>

#include "reco/direct_fit/cascade_fit.h"
#include "reco/direct_fit/goodness_of_fit.h"

namespace floe {

// The best turned about the string, with or without its direction mirrored.
struct AlikePlace {
  CascadeParameters cascade;
  Difference worse;  // than the best, in -ln L
};

// Turned by sixths of a circle. `photons`: of each of four simulations of each place; they are counted in
// `fit`. What is near the fit's other minimum is left out.
std::vector<AlikePlace> alike_places(ExpectationModel& light, const EventData& data, const Vec3& axis,
                                     const FitOptions& options, double photons, CascadeFit& fit);

// Mean square of (truth - best) when the truth may be at these places, too, each with the errors of the best
// and no more than its sixth of a circle: with the odds of its likelihood (share_of) less those that the
// Gaussian of the best gives it. A place that does not compete with the best has none. A covariance that is
// not finite stays as it was.
Matrix7 with_alike_places(const Matrix7& covariance, const CascadeParameters& best, const Vec3& axis,
                          const std::vector<AlikePlace>& places);

}  // namespace floe

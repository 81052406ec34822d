// Light that one string saw alone says nothing of the azimuth about that string, nor on which side of the
// plane through string and light it travels: what few photoelectrons others saw has to choose, and searches
// that walk downhill may end on the wrong side.
#pragma once

#include <optional>

#include "reco/direct_fit/cascade_parameters.h"
#include "reco/event_data.h"

namespace floe {

// A point on the string that saw nearly all of the light, if one did.
std::optional<Vec3> axis_of_only_string(const EventData& data);

// The same light, turned about the vertical through a point by an angle [rad].
LightCentre turned_about(const Vec3& axis, double angle, const LightCentre& light);
// And mirrored in the vertical plane through that point and the light, which only changes its direction.
LightCentre mirrored_about(const Vec3& axis, const LightCentre& light);

// Mean square of (truth - best), in the numbers of a cascade, where all the light is of the string through a
// point: the truth lies on an arc about it, inside the tangent that a covariance knows. With an azimuth of
// Gaussian error about the string, the distance from the tangent is added; all else is linear in that
// azimuth. A covariance that is not finite stays as it was.
Matrix7 with_arc_about(const Vec3& axis, const CascadeParameters& best, const Matrix7& covariance);

}  // namespace floe

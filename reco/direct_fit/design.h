// Where to simulate around a point: few simulations that tell all slopes equally well.
#pragma once

#include <cstdint>
#include <vector>

#include "data/base/vec3.h"
#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/local_frame.h"
#include "reco/direct_fit/poisson_regression.h"
#include "reco/event_data.h"

namespace floe {

// The centre and, mirrored through it, the corners of a regular simplex in five dimensions under a random
// rotation: 13 points, in units of the steps. Slopes in every direction are known equally well and are
// not mixed up with curvature; another `draw` gives another rotation, so that several rounds fill space.
std::vector<Coordinates> simplex_design(std::uint64_t seed, std::uint64_t draw);

// What a draw of the design simulates: a simplex of these steps around a point.
struct Stage {
  double position_step = 0;   // [m]
  double direction_step = 0;  // [rad]
  double oversize = 5;
  double photons = 0;  // of all simulations of the draw
};
// The draw's cascades around the frame's origin, in the order of the design, with streams from
// `first_stream`.
std::vector<LightRequest> design_requests(const LocalFrame& frame, const Stage& stage, CascadeKind kind,
                                          std::uint64_t seed, std::uint64_t draw, std::uint64_t first_stream);

// Photons that are worth simulating for a cascade: those of `events` repetitions of the measured light, but
// not less or more than that; `effort` multiplies them. Where modules see few of many photons, as in a layer
// of dust, there are up to four times as many, `most` too, until they make `hits` of the measured light: if
// there is enough of that to tell seven numbers with any use.
constexpr double worthwhile_charge = 30;  // [photoelectrons]
struct PhotonNeed {
  double events = 3, least = 1e6, most = 1e7;
  double hits = 2500;
};
double useful_photons(ExpectationModel& light, const CascadeParameters& cascade, const EventData& data,
                      double oversize, double effort, const PhotonNeed& need);

// The oversize of simulations that teach weights and slopes, which need many counts more than they need
// modules of the right size: 5 times that of the fit, between 12 and 60, never less than the fit's.
double training_oversize(double oversize);

// Directions spread evenly over the sphere (Fibonacci spiral).
std::vector<Vec3> even_directions(int count);

}  // namespace floe

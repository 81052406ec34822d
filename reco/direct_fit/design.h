// Where to simulate around a point: few simulations that tell all slopes equally well.
#pragma once

#include <cstdint>
#include <vector>

#include "data/base/vec3.h"
#include "reco/direct_fit/poisson_regression.h"

namespace floe {

// The centre and, mirrored through it, the corners of a regular simplex in five dimensions under a random
// rotation: 13 points, in units of the steps. Slopes in every direction are known equally well and are
// not mixed up with curvature; another `draw` gives another rotation, so that several rounds fill space.
std::vector<Coordinates> simplex_design(std::uint64_t seed, std::uint64_t draw);

// The oversize of simulations that teach weights and slopes, which need many counts more than they need
// modules of the right size: 2.5 times that of the fit, between 12 and 30, never less than the fit's.
double training_oversize(double oversize);

// Directions spread evenly over the sphere (Fibonacci spiral).
std::vector<Vec3> even_directions(int count);

}  // namespace floe

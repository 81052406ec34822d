// What a birefringent step and the scatter behind it say about the strength of birefringence.
//
// The score of the step's own normals is mostly noise that nobody can see: dust turns the photon right
// afterwards, and no module knows which of the two did how much. Its mean given the direction after the
// scatter has the same mean over photons and a fraction of the variance (Rao and Blackwell).
//
// The mean is taken over an orbit: steps as likely as the one that was drawn, which a lattice of rotations of
// its two uniform numbers makes of it. Given the orbit, each of its steps was the one with the probability
// that dust turned it the rest of the way, so that the mean is exact for an orbit of any size.
#pragma once

#include "data/base/vec3.h"
#include "propagation/engine/scattering.h"

namespace floe {

// A step and what followed; vectors by their components along the flow, across it and up.
struct BirefringentTurn {
  Vec3 before, x, y;                // direction, and the axes of the plane across it (FlowFrame)
  double width_x, width_y, mean_x;  // of the step in that plane [rad]
  double normal_x, normal_y;        // what was drawn: the step is width_x normal_x + mean_x, width_y normal_y
};

// Moments of the two normals.
struct TurnMoments {
  double squares, pull;  // of normal_x^2 + normal_y^2; of normal_x
};
inline TurnMoments moments_drawn(const BirefringentTurn& turn) {
  return {turn.normal_x * turn.normal_x + turn.normal_y * turn.normal_y, turn.normal_x};
}

// Their means given the direction `after` a scatter off dust that stretches directions by K1 and K2
// (scattering anisotropy; 1, 1: none).
TurnMoments moments_given_scatter(const BirefringentTurn& turn, const Vec3& after,
                                  const ScatteringFunction<float>& dust, double K1, double K2);

}  // namespace floe

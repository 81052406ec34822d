// The likelihood around a solution of the calibrated score (reco/direct_fit/calibrated_score.h).
#pragma once

#include <functional>

#include "reco/direct_fit/local_frame.h"

namespace floe {

// The score's seven sums say how far they are from what is expected at p. With that gap whitened by the
// covariance of data and simulation,
//   -ln L(p) + ln L(best) = |gap(p)|^2 / 2,
// seven sums for seven numbers, so that gap(best) = 0 within rounding.
struct ScoreLikelihood {
  struct Point {
    Vector7 gap = Vector7::Zero();
    Matrix7 slope = Matrix7::Zero();  // d gap / d p: a row each sum, a column each local number
  };
  // Safe to call from several threads, takes some ms; p: local numbers around `frame`. Does not throw.
  std::function<Point(const Vector7& p)> at;

  LocalFrame frame;
  Vector7 best;        // the solution, in local numbers
  Matrix7 covariance;  // of the local numbers; finite and positive definite
  Vector7 trusted;     // |p| up to which the sums mean something, per number
};

}  // namespace floe

// Half of the calibrated score: one emulator's weights, and simulations that say what its sums mean.
// Theory: docs/theory/direct_fit.md.
#pragma once

#include <vector>

#include "reco/direct_fit/calibrated_score.h"
#include "reco/direct_fit/score_weights.h"

namespace floe {

// One emulator's weights, with what the other one expects of the sums, set right by simulations that these
// weights do not know: the level by the narrow ones, the slopes mostly by the wide ones that taught the
// other emulator, since they reach further. `data` and the folds must outlive it.
class CalibratedFold {
 public:
  CalibratedFold(const EventData& data, const ScoreFold& own, const ScoreFold& other, double all_repeats,
                 double position_error);

  const ScoreWeights& weights() const { return weights_; }
  // When a trial at p arrives, less what following the valley would make of it [ns].
  double later(const Vector7& p) const { return p(5) - valley_.dot(p.head<regression_coordinates>()); }

  // What the correction is linear in: level of the narrow and of the wide simulations, which differ in
  // oversize, and the five coordinates.
  static constexpr int terms = 2 + regression_coordinates;
  using Terms = Eigen::Matrix<double, terms, 1>;
  using TermsFit = Eigen::Matrix<double, 7, terms>;

  // The simulated sums less the expected ones as a linear function of place and direction, of one event, and
  // its mean derivative in time.
  struct Correction {
    TermsFit fit;
    Vector7 by_time;
  };
  Correction correction(double later) const;

  // Chi-square of the narrow simulations about their fit.
  struct Spread {
    double square = 0;
    int freedom = 0;
  };
  Spread spread() const;

  // Weighted sums of the data, less those expected at p, with their derivatives.
  struct Score {
    Vector7 gap = Vector7::Zero();
    Matrix7 slope = Matrix7::Zero();  // d (expected sums) / dp
  };
  Score score(const Vector7& p, const Correction& correction) const;

  // Variance of the expected sums at p from the finite simulations.
  Matrix7 simulation_variance(const Vector7& p) const;

 private:
  struct Simulation {
    const LightSample* sample;
    bool narrow;
    Vector7 place;
    Terms x;
  };
  void add(const LightSample& sample, bool narrow);
  Vector7 residual(const Simulation& simulation, double later) const;
  TermsFit residual_fit(double later) const;
  Vector7 mean_residual(double later) const;

  const EventData& data_;
  const Emulator& other_;
  ScoreWeights weights_;
  Coordinates valley_;  // how the time has to follow place and direction for the sums in time to stay
  std::vector<Simulation> simulations_;
  Eigen::Matrix<double, terms, terms> inverse_normal_;
};

}  // namespace floe

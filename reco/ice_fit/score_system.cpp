#include "reco/ice_fit/score_system.h"

#include <algorithm>

namespace floe {

namespace {

// Slopes of ln(mu) per bin, ice parameters first, then brightness and time zero.
Eigen::MatrixXd logarithmic_slopes(const LightFold& fold) {
  const Eigen::Index parameters = fold.slopes.cols();
  const Eigen::ArrayXd counts = fold.counts.array().max(1);
  Eigen::MatrixXd slopes(fold.slopes.rows(), parameters + 2);
  slopes.leftCols(parameters) = fold.slopes.array().colwise() / counts;
  slopes.col(parameters).setOnes();
  slopes.col(parameters + 1) = fold.delay.array() / counts;
  return slopes;
}

// What is left of noisy slopes by Stein's argument: with power t^2 over the bins and noise v of a bin the
// best guess is t^2/(t^2 + v) of it. The power is the product of both folds' slopes, free of noise on
// average.
Eigen::MatrixXd weights(const LightFold& fold, const Eigen::MatrixXd& own, const Eigen::MatrixXd& other) {
  Eigen::MatrixXd result = own;
  const Eigen::ArrayXd counts = fold.counts.array().max(1);
  for (Eigen::Index p = 0; p < fold.slopes.cols(); ++p) {
    const double power =
        std::max(0.0, (own.col(p).array() * other.col(p).array() * counts).sum() / counts.sum());
    const Eigen::ArrayXd noise =
        (fold.slope_squares.col(p).array() / counts - own.col(p).array().square()).max(0) / counts;
    result.col(p).array() *= power / (power + noise).max(1e-30);
  }
  return result;
}

}  // namespace

void add_run(const RunLight& light, const RunCounts& counts, int nuisance, ScoreSystem& system) {
  const LightFold* folds = light.folds;
  const Eigen::Index parameters = folds[0].slopes.cols();
  const Eigen::MatrixXd slopes[2] = {logarithmic_slopes(folds[0]), logarithmic_slopes(folds[1])};
  const Eigen::MatrixXd weight[2] = {weights(folds[0], slopes[0], slopes[1]),
                                     weights(folds[1], slopes[1], slopes[0])};
  const Eigen::ArrayXd expected[2] = {counts.scale * folds[0].counts.array(),
                                      counts.scale * folds[1].counts.array()};
  const Eigen::ArrayXd mu = (expected[0] + expected[1]) / 2;
  const Eigen::ArrayXd simulated = (folds[0].counts + folds[1].counts).array().max(1);
  // Bins that the simulation does not know as well as the data count less.
  const double known = counts.model_error * counts.model_error;
  const Eigen::ArrayXd trust = 1 / (1 + mu * (1 / simulated + known));

  const Eigen::Index size = parameters + 2;
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(size);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(size, size), noise = slope;
  const auto add_noise = [&](const Eigen::MatrixXd& w, const Eigen::ArrayXd& variance) {
    noise += w.transpose() * (variance * trust.square()).matrix().asDiagonal() * w;
  };
  for (int fold = 0; fold < 2; ++fold) {
    const int other = 1 - fold;
    gap += weight[fold].transpose() * (trust * (counts.data.array() - expected[other])).matrix() / 2;
    slope += weight[fold].transpose() * (trust * expected[other]).matrix().asDiagonal() * weight[other] / 2;
    add_noise(weight[fold] / 2, counts.dispersion * counts.scale * expected[other]);
  }
  add_noise((weight[0] + weight[1]) / 2, counts.data_dispersion * mu + known * mu.square());

  // Into the system: the ice's columns, then the run's own two.
  const auto place = [&](Eigen::Index i) { return i < parameters ? i : nuisance + (i - parameters); };
  for (Eigen::Index i = 0; i < size; ++i) {
    system.gap(place(i)) += gap(i);
    for (Eigen::Index k = 0; k < size; ++k) {
      system.slope(place(i), place(k)) += slope(i, k);
      system.noise(place(i), place(k)) += noise(i, k);
    }
  }
}

}  // namespace floe

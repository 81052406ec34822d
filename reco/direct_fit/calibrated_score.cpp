#include "reco/direct_fit/calibrated_score.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <memory>

#include "reco/direct_fit/limited_step.h"
#include "reco/direct_fit/local_fit.h"
#include "reco/direct_fit/score_fold.h"

namespace floe {
namespace {

constexpr int newton_steps = 14, full_steps = 4;
constexpr double bound_position_error = 0.2;  // [m]

class CalibratedScore {
 public:
  CalibratedScore(const EventData& data, std::span<const ScoreFold, 2> folds, double position_error)
      : data_(data),
        emulator_(folds[0].emulator),
        folds_{CalibratedFold(data, folds[0], folds[1], repeats(folds), position_error),
               CalibratedFold(data, folds[1], folds[0], repeats(folds), position_error)} {
    const CalibratedFold::Spread a = folds_[0].spread(), b = folds_[1].spread();
    if (a.freedom + b.freedom > 0) dispersion_ = (a.square + b.square) / (a.freedom + b.freedom);
    set_time(Vector7::Zero());
  }

  double dispersion() const { return dispersion_; }

  // The correction is that of simulations arriving when they do at p.
  void set_time(const Vector7& p) {
    for (std::size_t k = 0; k < 2; ++k) corrections_[k] = folds_[k].correction(folds_[k].later(p));
  }

  CalibratedFold::Score score(const Vector7& p) const {
    const CalibratedFold::Score a = folds_[0].score(p, corrections_[0]);
    const CalibratedFold::Score b = folds_[1].score(p, corrections_[1]);
    return {0.5 * (a.gap + b.gap), 0.5 * (a.slope + b.slope)};
  }

  // Variance of the data's sums with the mean of both folds' weights.
  Matrix7 data_variance(const Vector7& p) const {
    const double error = emulator_.settings().model_error;
    const Matrix7 counts =
        sum_over_bins(p, [&](std::size_t, double mean) { return mean + error * error * mean * mean; });
    return counts + 0.5 * (folds_[0].weights().distrust() + folds_[1].weights().distrust());
  }

  // At the origin: variance of Poisson counts in the sums with the mean of both folds' weights, and what it
  // would be without the weights' noise, which is independent between the folds.
  struct WeightVariance {
    Matrix7 all = Matrix7::Zero(), without_noise = Matrix7::Zero();
  };
  WeightVariance weight_variance() const {
    std::vector<Emulator::Evaluation> values;
    emulator_.evaluate(Vector7::Zero(), values);
    WeightVariance sum;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vector7 &a = folds_[0].weights()[i], &b = folds_[1].weights()[i];
      const Emulator::Bin& bin = emulator_.bins()[i];
      const double variance = bin.saturated ? emulator_.likelihood(bin, values[i].log_mean).curvature
                                            : data_.repeats() * std::exp(values[i].log_mean);
      sum.all += 0.25 * variance * (a + b) * (a + b).transpose();
      sum.without_noise += 0.5 * variance * (a * b.transpose() + b * a.transpose());
    }
    return sum;
  }

  // The slopes if the weights were perfect: what all sums' variance is for them.
  Matrix7 best_slopes() const {
    return sum_over_bins(Vector7::Zero(), [&](std::size_t i, double mean) {
      return folds_[0].weights().relative_variance(i) * mean;
    });
  }

  Matrix7 simulation_variance(const Vector7& p) const {
    return 0.25 * dispersion_ * (folds_[0].simulation_variance(p) + folds_[1].simulation_variance(p));
  }

 private:
  // Of variance(bin, expected counts) times the square of the mean of both folds' weights.
  template <class Variance>
  Matrix7 sum_over_bins(const Vector7& p, Variance variance) const {
    std::vector<Emulator::Evaluation> values;
    emulator_.evaluate(p, values);
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vector7 weight = 0.5 * (folds_[0].weights()[i] + folds_[1].weights()[i]);
      const Emulator::Bin& bin = emulator_.bins()[i];
      const double here = bin.saturated ? emulator_.likelihood(bin, values[i].log_mean).curvature
                                        : variance(i, data_.repeats() * std::exp(values[i].log_mean));
      sum += here * weight * weight.transpose();
    }
    return sum;
  }

  static double repeats(std::span<const ScoreFold, 2> folds) {
    double sum = 0;
    for (const ScoreFold& fold : folds)
      for (const LightSample* sample : fold.fresh) sum += sample->repeats;
    return sum;
  }

  const EventData& data_;
  const Emulator& emulator_;
  std::array<CalibratedFold, 2> folds_;
  std::array<CalibratedFold::Correction, 2> corrections_;
  double dispersion_ = 1;
};

Matrix7 sandwich(const Matrix7& slope, const Matrix7& variance) {
  const Matrix7 inverse = slope.inverse();
  return inverse * variance * inverse.transpose();
}

InformationBound bound_of(const CalibratedScore& score) {
  const Matrix7 slope = score.score(Vector7::Zero()).slope;
  const CalibratedScore::WeightVariance variance = score.weight_variance();
  InformationBound bound;
  const Eigen::LLT<Matrix7> root(variance.without_noise);
  if (!slope.allFinite() || !variance.all.allFinite() || root.info() != Eigen::Success) {
    bound.covariance = sandwich(slope, variance.all);
    return bound;
  }
  bound.covariance = sandwich(slope, variance.without_noise);
  const Matrix7 half = root.matrixL().solve(variance.all);
  const Matrix7 ratio = root.matrixL().solve(Matrix7(half.transpose()));
  bound.weight_loss =
      Eigen::SelfAdjointEigenSolver<Matrix7>(ratio, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  return bound;
}

}  // namespace

ScoreSolution solve_calibrated_score(const EventData& data, std::span<const ScoreFold, 2> folds,
                                     double position_error) {
  CalibratedScore score(data, folds, position_error);
  ScoreSolution solution;
  solution.dispersion = score.dispersion();
  solution.weight_loss = bound_of(score).weight_loss;
  const Vector7 most = trust_region(folds[0].emulator.settings());
  const Matrix7 best = score.best_slopes();
  CalibratedFold::Score now = score.score(solution.step);
  Matrix7 slope;
  double change_square = 0;
  for (int i = 0; i < newton_steps && !solution.converged; ++i) {
    slope = now.slope;
    if (!slope.allFinite()) return solution;
    Vector7 change = slope.partialPivLu().solve(now.gap);
    change_square = change.dot(best * change);
    if (i >= full_steps) change *= 0.5;  // simulated photons cross the edges of bins one by one
    const Vector7 next = solution.step + change;
    const double length = next.cwiseAbs().cwiseQuotient(most).maxCoeff();
    solution.step = limited_step(next, slope, best, most);
    if (length > 1 && i >= full_steps) {
      solution.leaves = true;
      break;
    }
    score.set_time(solution.step);
    now = score.score(solution.step);
    solution.converged = length <= 1 && change_square < 0.01;
  }
  // What is left of the noise is small in units of the errors.
  solution.converged = change_square < 0.1 && !solution.leaves;
  const Matrix7 of_data = score.data_variance(solution.step);
  solution.data_covariance = sandwich(slope, of_data);
  solution.covariance = sandwich(slope, of_data + score.simulation_variance(solution.step));
  return solution;
}

ScoreLikelihood score_likelihood(const EventData& data, std::span<const ScoreFold, 2> folds,
                                 const ScoreSolution& solution, double position_error,
                                 double excess_scatter) {
  const auto score = std::make_shared<CalibratedScore>(data, folds, position_error);
  score->set_time(solution.step);
  const Matrix7 variance =
      (1 + excess_scatter) * score->data_variance(solution.step) + score->simulation_variance(solution.step);
  const Matrix7 whitening = variance.llt().matrixL().solve(Matrix7::Identity());
  const Vector7 left = score->score(solution.step).gap;  // by the last Newton step
  const auto at = [score, whitening, left](const Vector7& p) {
    const CalibratedFold::Score there = score->score(p);
    return ScoreLikelihood::Point{whitening * (left - there.gap), whitening * there.slope};
  };
  const Emulator& emulator = folds[0].emulator;
  return {at, emulator.frame(), solution.step,
          solution.covariance + excess_scatter * solution.data_covariance, trust_region(emulator.settings())};
}

InformationBound cramer_rao_bound(const EventData& data, std::span<const ScoreFold, 2> folds) {
  return bound_of(CalibratedScore(data, folds, bound_position_error));
}

}  // namespace floe

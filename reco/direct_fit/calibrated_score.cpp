#include "reco/direct_fit/calibrated_score.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <cassert>
#include <cmath>

#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/direct_fit/local_fit.h"

namespace floe {
namespace {

constexpr int newton_steps = 14, full_steps = 4;
constexpr double least_share = 0.2;
constexpr double significant = 3;  // standard deviations
constexpr double time_step = 1;    // of the numeric derivative in time [ns]
using Linear = Eigen::Matrix<double, 1 + regression_coordinates, 1>;  // 1 and the five coordinates
using LinearFit = Eigen::Matrix<double, 7, 1 + regression_coordinates>;

Linear linear_terms(const Vector7& p) {
  Linear x;
  x << 1, p.head<regression_coordinates>();
  return x;
}

// One emulator's weights, with what the other one expects of the sums, set right by the simulations that the
// other was trained on and this one does not know.
class Fold {
 public:
  Fold(const EventData& data, const ScoreFold& own, const Emulator& other, double all_repeats)
      : data_(data), own_(own.emulator), other_(other), samples_(own.fresh) {
    set_weights(all_repeats);
    Design normal = Design::Zero();
    for (const LightSample* sample : samples_) {
      places_.push_back(own_.frame().of(light_centre(sample->cascade, own_.settings().kind)));
      const Linear x = linear_terms(places_.back());
      normal += sample->repeats * x * x.transpose();
    }
    inverse_normal_ = normal.inverse();
  }

  const std::vector<Vector7>& weights() const { return weights_; }
  // Of a bin's count about its expectation, with finite simulation and model error, in units of Poisson's.
  double relative_variance(std::size_t bin) const { return relative_variance_[bin]; }

  // The simulated sums less the expected ones as a linear function of place and direction, of one event, and
  // its derivative in time. How much of the slopes is more than noise is up to `keep`.
  struct Correction {
    LinearFit fit, by_time;
  };
  Correction correction(double later) const {
    return {residual_fit(later),
            (residual_fit(later + time_step) - residual_fit(later - time_step)) / (2 * time_step)};
  }

  // Chi-square of the slopes about 0, and of the simulations about their fit.
  struct Spread {
    double slopes = 0, scatter = 0;
    int slope_freedom = 0, scatter_freedom = 0;
  };
  Spread spread() const {
    const LinearFit fit = residual_fit(0);
    const Eigen::LDLT<Matrix7> variance(poisson_variance());
    Spread result;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const Vector7 gap = residual(k, 0) - fit * linear_terms(places_[k]);
      result.scatter += samples_[k]->repeats * gap.dot(variance.solve(gap));
    }
    result.scatter_freedom = 7 * (static_cast<int>(samples_.size()) - 1 - regression_coordinates);
    const auto slopes = fit.rightCols<regression_coordinates>();
    const auto block = inverse_normal_.bottomRightCorner<regression_coordinates, regression_coordinates>();
    result.slopes = (variance.solve(slopes) * block.inverse() * slopes.transpose()).trace();
    result.slope_freedom = 7 * regression_coordinates;
    return result;
  }

  // Weighted sums of the data, less those expected at p, with their derivatives.
  struct Score {
    Vector7 gap = Vector7::Zero();
    Matrix7 slope = Matrix7::Zero();  // d (expected sums) / dp
  };
  Score score(const Vector7& p, const Correction& correction, double keep) const {
    std::vector<Emulator::Evaluation> values;
    other_.evaluate(p, values);
    const double events = data_.repeats();
    Score result;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = other_.bins()[i];
      if (bin.left_out) continue;
      if (bin.saturated) {
        const BinLikelihood known = other_.likelihood(bin, values[i].log_mean);
        result.gap -= known.slope * weights_[i];
        result.slope += known.curvature * weights_[i] * values[i].gradient.transpose();
        continue;
      }
      const double mean = events * std::exp(values[i].log_mean);
      result.gap += (bin.data - mean) * weights_[i];
      result.slope += mean * weights_[i] * values[i].gradient.transpose();
    }
    Linear x = linear_terms(p);
    x.tail<regression_coordinates>() *= keep;
    const double light = events * std::exp(p(6));
    result.gap -= light * correction.fit * x;
    result.slope.leftCols<regression_coordinates>() +=
        light * keep * correction.fit.rightCols<regression_coordinates>();
    result.slope.col(5) += light * correction.by_time * x;
    result.slope.col(6) += light * correction.fit * x;
    return result;
  }

  // Variance of the expected sums at p from the finite simulations.
  Matrix7 simulation_variance(const Vector7& p, double keep) const {
    Linear x = linear_terms(p);
    x.tail<regression_coordinates>() *= keep;
    const double events = data_.repeats() * std::exp(p(6));
    return events * events * x.dot(inverse_normal_ * x) * poisson_variance();
  }

 private:
  using Design = Eigen::Matrix<double, regression_coordinates + 1, regression_coordinates + 1>;

  // Gradient over variance: of data, finite simulation and model error, relative to Poisson's of the data.
  void set_weights(double all_repeats) {
    std::vector<Emulator::Evaluation> values;
    own_.evaluate(Vector7::Zero(), values);
    const double error = own_.settings().model_error;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = own_.bins()[i];
      const double mean = data_.repeats() * std::exp(values[i].log_mean);
      means_.push_back(mean);
      const double variance = 1 + data_.repeats() / all_repeats + error * error * mean;
      relative_variance_.push_back(variance);
      weights_.push_back(bin.left_out    ? Vector7::Zero()
                         : bin.saturated ? values[i].gradient
                                         : Vector7(values[i].gradient / variance));
    }
  }

  // Of one event of simulation: sums of weights squared times expectation.
  Matrix7 poisson_variance() const {
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i < weights_.size(); ++i)
      if (!own_.bins()[i].saturated)
        sum += means_[i] / data_.repeats() * weights_[i] * weights_[i].transpose();
    return sum;
  }

  // Simulated less expected sums of one event, of simulation k arriving `later`.
  Vector7 residual(std::size_t k, double later) const {
    const LightSample& sample = *samples_[k];
    const auto bins = count_bins(data_, sample, sample.cascade.time + later - places_[k](5));
    Vector7 p = places_[k];
    p(5) = later;
    const double brighter = std::exp(p(6));
    p(6) = 0;
    std::vector<Emulator::Evaluation> values;
    other_.evaluate(p, values);
    Vector7 sum = Vector7::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = other_.bins()[i];
      if (bin.saturated || bin.left_out) continue;
      const double simulated = (bins[i].simulation / bins[i].simulation_events - bin.noise) / brighter;
      sum += (simulated - (std::exp(values[i].log_mean) - bin.noise)) * weights_[i];
    }
    return sum;
  }

  LinearFit residual_fit(double later) const {
    LinearFit sum = LinearFit::Zero();
    for (std::size_t k = 0; k < samples_.size(); ++k)
      sum += samples_[k]->repeats * residual(k, later) * linear_terms(places_[k]).transpose();
    return sum * inverse_normal_;
  }

  const EventData& data_;
  const Emulator &own_, &other_;
  std::span<const LightSample* const> samples_;
  std::vector<Vector7> weights_, places_;
  std::vector<double> means_, relative_variance_;  // of the data
  Design inverse_normal_;
};

class CalibratedScore {
 public:
  CalibratedScore(const EventData& data, std::span<const ScoreFold, 2> folds)
      : data_(data),
        emulator_(folds[0].emulator),
        folds_{Fold(data, folds[0], folds[1].emulator, repeats(folds)),
               Fold(data, folds[1], folds[0].emulator, repeats(folds))} {
    const Fold::Spread a = folds_[0].spread(), b = folds_[1].spread();
    if (a.scatter_freedom + b.scatter_freedom > 0)
      dispersion_ = (a.scatter + b.scatter) / (a.scatter_freedom + b.scatter_freedom);
    // Slopes of the correction that noise alone would make are none (James and Stein).
    const double freedom = a.slope_freedom + b.slope_freedom, square = (a.slopes + b.slopes) / dispersion_;
    keep_ = square > freedom + significant * std::sqrt(2 * freedom) ? 1 - freedom / square : 0;
    set_time(0);
  }

  double dispersion() const { return dispersion_; }
  double keep() const { return keep_; }

  // The correction is that of simulations arriving so much later.
  void set_time(double later) {
    for (std::size_t k = 0; k < 2; ++k) corrections_[k] = folds_[k].correction(later);
  }

  Fold::Score score(const Vector7& p) const {
    const Fold::Score a = folds_[0].score(p, corrections_[0], keep_);
    const Fold::Score b = folds_[1].score(p, corrections_[1], keep_);
    return {0.5 * (a.gap + b.gap), 0.5 * (a.slope + b.slope)};
  }

  // Variance of the data's sums with the mean of both folds' weights.
  Matrix7 data_variance(const Vector7& p) const {
    std::vector<Emulator::Evaluation> values;
    emulator_.evaluate(p, values);
    const double error = emulator_.settings().model_error;
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vector7 weight = 0.5 * (folds_[0].weights()[i] + folds_[1].weights()[i]);
      const double mean = data_.repeats() * std::exp(values[i].log_mean);
      const Emulator::Bin& bin = emulator_.bins()[i];
      const double variance = bin.saturated ? emulator_.likelihood(bin, values[i].log_mean).curvature
                                            : mean + error * error * mean * mean;
      sum += variance * weight * weight.transpose();
    }
    return sum;
  }

  // The slopes if the weights were perfect: what all sums' variance is for them.
  Matrix7 best_slopes() const {
    std::vector<Emulator::Evaluation> values;
    emulator_.evaluate(Vector7::Zero(), values);
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = emulator_.bins()[i];
      if (bin.left_out) continue;
      const Vector7 weight = 0.5 * (folds_[0].weights()[i] + folds_[1].weights()[i]);
      const double mean =
          bin.saturated ? emulator_.likelihood(bin, values[i].log_mean).curvature
                        : folds_[0].relative_variance(i) * data_.repeats() * std::exp(values[i].log_mean);
      sum += mean * weight * weight.transpose();
    }
    return sum;
  }

  Matrix7 simulation_variance(const Vector7& p) const {
    return 0.25 * dispersion_ *
           (folds_[0].simulation_variance(p, keep_) + folds_[1].simulation_variance(p, keep_));
  }

 private:
  static double repeats(std::span<const ScoreFold, 2> folds) {
    double sum = 0;
    for (const ScoreFold& fold : folds)
      for (const LightSample* sample : fold.fresh) sum += sample->repeats;
    return sum;
  }

  const EventData& data_;
  const Emulator& emulator_;
  std::array<Fold, 2> folds_;
  std::array<Fold::Correction, 2> corrections_;
  double dispersion_ = 1, keep_ = 1;
};

// The slopes as they can be: symmetric, and in no direction more than the variance of the sums, which they
// equal for perfect weights (the information inequality). Where noise leaves less than `least_share` of it,
// that much is assumed.
Matrix7 possible_slopes(const Matrix7& slope, const Matrix7& variance) {
  if (!slope.allFinite() || !variance.allFinite()) return Matrix7::Constant(std::nan(""));
  const Matrix7 half = 0.5 * (slope + slope.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix7> solver(half, variance);
  if (solver.info() != Eigen::Success) return Matrix7::Constant(std::nan(""));
  const Vector7 share = solver.eigenvalues().cwiseMax(least_share).cwiseMin(1);
  const Matrix7 inverse = solver.eigenvectors().transpose() * variance;
  return inverse.transpose() * share.asDiagonal() * inverse;
}

Matrix7 sandwich(const Matrix7& slope, const Matrix7& variance) {
  const Matrix7 inverse = slope.inverse();
  return inverse * variance * inverse.transpose();
}

}  // namespace

ScoreSolution solve_calibrated_score(const EventData& data, std::span<const ScoreFold, 2> folds) {
  CalibratedScore score(data, folds);
  ScoreSolution solution;
  solution.dispersion = score.dispersion();
  const Vector7 most = trust_region(folds[0].emulator.settings());
  const Matrix7 best = score.best_slopes();
  Fold::Score now = score.score(solution.step);
  Matrix7 slope;
  double change_square = 0;
  for (int i = 0; i < newton_steps && !solution.converged; ++i) {
    slope = possible_slopes(now.slope, best);
    if (!slope.allFinite()) return solution;
    Vector7 change = slope.ldlt().solve(now.gap);
    change_square = change.dot(slope * change);
    if (i >= full_steps) change *= 0.5;  // simulated photons cross the edges of bins one by one
    const Vector7 next = solution.step + change;
    const double length = next.cwiseAbs().cwiseQuotient(most).maxCoeff();
    solution.step = length > 1 ? Vector7(next / length) : next;
    if (length > 1 && i >= full_steps) {
      solution.leaves = true;
      break;
    }
    score.set_time(solution.step(5));
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

Matrix7 cramer_rao_bound(const EventData& data, std::span<const ScoreFold, 2> folds) {
  const CalibratedScore score(data, folds);
  const Vector7 here = Vector7::Zero();
  return sandwich(possible_slopes(score.score(here).slope, score.best_slopes()), score.data_variance(here));
}

}  // namespace floe

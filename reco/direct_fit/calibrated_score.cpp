#include "reco/direct_fit/calibrated_score.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <memory>

#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/direct_fit/local_fit.h"

namespace floe {
namespace {

constexpr int newton_steps = 14, full_steps = 4;
constexpr double timing_share = 0.3;  // of an error in place that the geometry of times does not follow
constexpr double bright = 20;         // [photoelectrons] of a module that may lead the fit astray
constexpr double usual_scatter = 6;   // the largest of seven mean squares of a dozen simulations
constexpr double bound_position_error = 0.2;  // [m]
constexpr double time_step = 3;               // of the numeric derivative in time [ns]

// What the sums' correction is linear in: level of the narrow and of the wide simulations, which differ in
// oversize, and the five coordinates.
constexpr int terms = 2 + regression_coordinates;
using Terms = Eigen::Matrix<double, terms, 1>;
using TermsFit = Eigen::Matrix<double, 7, terms>;
using Normal = Eigen::Matrix<double, terms, terms>;

Terms terms_at(const Vector7& p, bool narrow) {
  Terms x;
  x << narrow, !narrow, p.head<regression_coordinates>();
  return x;
}

// One emulator's weights, with what the other one expects of the sums, set right by simulations that these
// weights do not know: the level by the narrow ones, the slopes mostly by the wide ones that taught the
// other emulator, since they reach further.
class Fold {
 public:
  Fold(const EventData& data, const ScoreFold& own, const ScoreFold& other, double all_repeats,
       double position_error)
      : data_(data), own_(own.emulator), other_(other.emulator) {
    set_weights(all_repeats);
    weaken_modules(other.fresh);
    for_each_module([&](std::size_t begin, std::size_t end) { distrust_module(begin, end, position_error); });
    const Matrix7 information = poisson_variance();
    valley_ = -information.row(5).head<regression_coordinates>().transpose() / information(5, 5);
    for (const LightSample* sample : own.fresh) add(*sample, true);
    for (const LightSample* sample : other.training) add(*sample, false);
    Normal normal = Normal::Zero();
    for (const Simulation& k : simulations_) normal += k.sample->repeats * k.x * k.x.transpose();
    inverse_normal_ = normal.inverse();
  }

  const std::vector<Vector7>& weights() const { return weights_; }
  double later(const Vector7& p) const { return p(5) - valley_.dot(p.head<regression_coordinates>()); }
  // Variance of the data's sums from what modules were let float by.
  const Matrix7& distrust() const { return distrust_; }
  // Of a bin's count about its expectation, with finite simulation and model error, in units of Poisson's.
  double relative_variance(std::size_t bin) const { return relative_variance_[bin]; }

  // The simulated sums less the expected ones as a linear function of place and direction, of one event, and
  // its mean derivative in time.
  struct Correction {
    TermsFit fit;
    Vector7 by_time;
  };
  Correction correction(double later) const {
    return {residual_fit(later),
            (mean_residual(later + time_step) - mean_residual(later - time_step)) / (2 * time_step)};
  }

  // Chi-square of the narrow simulations about their fit.
  struct Spread {
    double square = 0;
    int freedom = 0;
  };
  Spread spread() const {
    const TermsFit fit = residual_fit(0);
    const Eigen::LDLT<Matrix7> variance(poisson_variance());
    Spread result;
    result.freedom = -7;
    for (const Simulation& k : simulations_) {
      if (!k.narrow) continue;
      const Vector7 gap = residual(k, 0) - fit * k.x;
      result.square += k.sample->repeats * gap.dot(variance.solve(gap));
      result.freedom += 7;
    }
    return result;
  }

  // Weighted sums of the data, less those expected at p, with their derivatives.
  struct Score {
    Vector7 gap = Vector7::Zero();
    Matrix7 slope = Matrix7::Zero();  // d (expected sums) / dp
  };
  Score score(const Vector7& p, const Correction& correction) const {
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
    const double light = events * std::exp(p(6));
    const Vector7 level = light * correction.fit * terms_at(p, true);
    result.gap -= level;
    result.slope.leftCols<regression_coordinates>() +=
        light *
        (correction.fit.rightCols<regression_coordinates>() - correction.by_time * valley_.transpose());
    result.slope.col(5) += light * correction.by_time;
    result.slope.col(6) += level;
    return result;
  }

  // Variance of the expected sums at p from the finite simulations.
  Matrix7 simulation_variance(const Vector7& p) const {
    const Terms x = terms_at(p, true);
    const double events = data_.repeats() * std::exp(p(6));
    return events * events * x.dot(inverse_normal_ * x) * poisson_variance();
  }

 private:
  struct Simulation {
    const LightSample* sample;
    bool narrow;
    Vector7 place;
    Terms x;
  };

  void add(const LightSample& sample, bool narrow) {
    const Vector7 place = own_.frame().of(light_centre(sample.cascade, own_.settings().kind));
    simulations_.push_back({&sample, narrow, place, terms_at(place, narrow)});
  }

  // Gradient over variance: of data, finite simulation and model error, relative to Poisson's of the data.
  void set_weights(double all_repeats) {
    std::vector<Emulator::Evaluation> values;
    own_.evaluate(Vector7::Zero(), values);
    const double error = own_.settings().model_error;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Emulator::Bin& bin = own_.bins()[i];
      const double mean = data_.repeats() * std::exp(values[i].log_mean);
      means_.push_back(mean);
      // What the emulator cannot follow counts against a bin, as in the emulated likelihood.
      const double unknown = error * error + 1 / own_.bins()[i].effective_counts;
      const double variance = 1 + data_.repeats() / all_repeats + unknown * mean;
      relative_variance_.push_back(variance);
      weights_.push_back(bin.left_out    ? Vector7::Zero()
                         : bin.saturated ? values[i].gradient
                                         : Vector7(values[i].gradient / variance));
      by_time_.push_back(values[i].gradient(5));
    }
  }

  template <class Do>
  void for_each_module(Do what) const {
    for (std::size_t begin = 0, end = 0; begin < own_.bins().size(); begin = end) {
      while (end < own_.bins().size() && own_.bins()[end].module == own_.bins()[begin].module) ++end;
      what(begin, end);
    }
  }

  // Simulated less expected count of every bin in one event of a simulation.
  std::vector<double> gaps(const LightSample& sample, const Emulator& emulator) const {
    Vector7 p = emulator.frame().of(light_centre(sample.cascade, emulator.settings().kind));
    const double brighter = std::exp(p(6));
    p(6) = 0;
    const auto counts = count_bins(data_, sample, sample.cascade.time);
    std::vector<Emulator::Evaluation> values;
    emulator.evaluate(p, values);
    std::vector<double> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double noise = emulator.bins()[i].noise;
      const double simulated = (counts[i].simulation / counts[i].simulation_events - noise) / brighter;
      result.push_back(simulated - (std::exp(values[i].log_mean) - noise));
    }
    return result;
  }

  // Very near modules see light change in ways that the emulator cannot follow. Where simulations that no
  // weight knows scatter in a module's sums by more than their counts explain, its weights are reduced.
  void weaken_modules(std::span<const LightSample* const> judges) {
    std::vector<std::vector<double>> all;
    for (const LightSample* sample : judges) all.push_back(gaps(*sample, own_));
    for_each_module([&](std::size_t begin, std::size_t end) {
      Vector7 found = Vector7::Zero(), poisson = Vector7::Constant(1e-300);
      double light = 0;
      for (std::size_t i = begin; i < end; ++i) {
        light += means_[i];
        poisson += means_[i] / data_.repeats() * weights_[i].cwiseAbs2();
      }
      if (light < bright || own_.bins()[begin].saturated || own_.bins()[begin].left_out) return;
      for (std::size_t k = 0; k < all.size(); ++k) {
        Vector7 sum = Vector7::Zero();
        for (std::size_t i = begin; i < end; ++i) sum += all[k][i] * weights_[i];
        found += judges[k]->repeats * sum.cwiseAbs2() / double(all.size());
      }
      const double scatter = found.cwiseQuotient(poisson).maxCoeff();
      if (scatter > usual_scatter)
        for (std::size_t i = begin; i < end; ++i) weights_[i] *= usual_scatter / scatter;
    });
  }

  // The emulator is not exact over the uncertainty of the place: one bright module may fix its time to 0.1
  // ns, or its light to a per cent, better than anything moved by metres is known to be. Such sums would be
  // far from linear over the region that matters. So each module's time and brightness are let float by what
  // the uncertainty of the place leaves open, which takes that much out of the weights (Woodbury's formula).
  void distrust_module(std::size_t begin, std::size_t end, double position_error) {
    const Emulator::Bin& first = own_.bins()[begin];
    if (first.saturated) return;
    const Vec3 way = data_.detector().modules()[first.module].position - own_.frame().origin().position;
    const double curved = position_error / soft_distance(way);
    const Eigen::Vector2d error(timing_share * light_slowness() * position_error * std::min(1.0, curved),
                                curved * curved);
    Eigen::Matrix2d known = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, 7> sum = Eigen::Matrix<double, 2, 7>::Zero(), left = sum;
    const auto nuisance = [&](std::size_t i) -> Eigen::Vector2d {
      return error.cwiseProduct(Eigen::Vector2d(by_time_[i], 1));
    };
    for (std::size_t i = begin; i < end; ++i) {
      if (own_.bins()[i].left_out) continue;
      known += means_[i] / relative_variance_[i] * nuisance(i) * nuisance(i).transpose();
      sum += means_[i] * nuisance(i) * weights_[i].transpose();
    }
    const Eigen::Matrix<double, 2, 7> part = (Eigen::Matrix2d::Identity() + known).llt().solve(sum);
    for (std::size_t i = begin; i < end; ++i) {
      if (own_.bins()[i].left_out) continue;
      weights_[i] -= part.transpose() * nuisance(i) / relative_variance_[i];
      left += means_[i] * nuisance(i) * weights_[i].transpose();
    }
    distrust_ += left.transpose() * left;
  }

  // Of one event of simulation: sums of weights squared times expectation.
  Matrix7 poisson_variance() const {
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i < weights_.size(); ++i)
      if (!own_.bins()[i].saturated)
        sum += means_[i] / data_.repeats() * weights_[i] * weights_[i].transpose();
    return sum;
  }

  // Simulated less expected sums of one event, of a simulation arriving `later`.
  Vector7 residual(const Simulation& k, double later) const {
    const LightSample& sample = *k.sample;
    Vector7 p = k.place;
    p(5) = later + valley_.dot(p.head<regression_coordinates>());
    const auto bins = count_bins(data_, sample, sample.cascade.time + p(5) - k.place(5));
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

  TermsFit residual_fit(double later) const {
    TermsFit sum = TermsFit::Zero();
    for (const Simulation& k : simulations_) sum += k.sample->repeats * residual(k, later) * k.x.transpose();
    return sum * inverse_normal_;
  }

  Vector7 mean_residual(double later) const {
    Vector7 sum = Vector7::Zero();
    double repeats = 0;
    for (const Simulation& k : simulations_) {
      sum += k.sample->repeats * residual(k, later);
      repeats += k.sample->repeats;
    }
    return sum / repeats;
  }

  const EventData& data_;
  const Emulator &own_, &other_;
  Coordinates valley_;  // how the time has to follow place and direction for the sums in time to stay
  std::vector<Simulation> simulations_;
  std::vector<Vector7> weights_;
  std::vector<double> means_, relative_variance_;  // of the data
  std::vector<double> by_time_;                    // d ln(expectation) / dt
  Matrix7 distrust_ = Matrix7::Zero();
  Normal inverse_normal_;
};

class CalibratedScore {
 public:
  CalibratedScore(const EventData& data, std::span<const ScoreFold, 2> folds, double position_error)
      : data_(data),
        emulator_(folds[0].emulator),
        folds_{Fold(data, folds[0], folds[1], repeats(folds), position_error),
               Fold(data, folds[1], folds[0], repeats(folds), position_error)} {
    const Fold::Spread a = folds_[0].spread(), b = folds_[1].spread();
    if (a.freedom + b.freedom > 0) dispersion_ = (a.square + b.square) / (a.freedom + b.freedom);
    set_time(Vector7::Zero());
  }

  double dispersion() const { return dispersion_; }

  // The correction is that of simulations arriving when they do at p.
  void set_time(const Vector7& p) {
    for (std::size_t k = 0; k < 2; ++k) corrections_[k] = folds_[k].correction(folds_[k].later(p));
  }

  Fold::Score score(const Vector7& p) const {
    const Fold::Score a = folds_[0].score(p, corrections_[0]);
    const Fold::Score b = folds_[1].score(p, corrections_[1]);
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
    return sum + 0.5 * (folds_[0].distrust() + folds_[1].distrust());
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
      const double mean = data_.repeats() * std::exp(values[i].log_mean);
      sum.all += 0.25 * mean * (a + b) * (a + b).transpose();
      sum.without_noise += 0.5 * mean * (a * b.transpose() + b * a.transpose());
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
    return 0.25 * dispersion_ * (folds_[0].simulation_variance(p) + folds_[1].simulation_variance(p));
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
  Fold::Score now = score.score(solution.step);
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
    solution.step = length > 1 ? Vector7(next / length) : next;
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
                                 const ScoreSolution& solution, double position_error) {
  const auto score = std::make_shared<CalibratedScore>(data, folds, position_error);
  score->set_time(solution.step);
  const Matrix7 variance = score->data_variance(solution.step) + score->simulation_variance(solution.step);
  const Matrix7 whitening = variance.llt().matrixL().solve(Matrix7::Identity());
  const Vector7 left = score->score(solution.step).gap;  // by the last Newton step
  const auto at = [score, whitening, left](const Vector7& p) {
    const Fold::Score there = score->score(p);
    return ScoreLikelihood::Point{whitening * (left - there.gap), whitening * there.slope};
  };
  const Emulator& emulator = folds[0].emulator;
  return {at, emulator.frame(), solution.step, solution.covariance, trust_region(emulator.settings())};
}

InformationBound cramer_rao_bound(const EventData& data, std::span<const ScoreFold, 2> folds) {
  return bound_of(CalibratedScore(data, folds, bound_position_error));
}

}  // namespace floe

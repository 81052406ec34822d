#include "reco/direct_fit/score_fold.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace floe {
namespace {

constexpr double time_step = 3;  // of the numeric derivative in time [ns]

CalibratedFold::Terms terms_at(const Vector7& p, bool narrow) {
  CalibratedFold::Terms x;
  x << narrow, !narrow, p.head<regression_coordinates>();
  return x;
}

}  // namespace

CalibratedFold::CalibratedFold(const EventData& data, const ScoreFold& own, const ScoreFold& other,
                               double all_repeats, double position_error)
    : data_(data),
      other_(other.emulator),
      weights_(data, own.emulator, all_repeats, other.fresh, position_error) {
  const Matrix7 information = weights_.poisson_variance();
  valley_ = -information.row(5).head<regression_coordinates>().transpose() / information(5, 5);
  for (const LightSample* sample : own.fresh) add(*sample, true);
  for (const LightSample* sample : other.training) add(*sample, false);
  Eigen::Matrix<double, terms, terms> normal = Eigen::Matrix<double, terms, terms>::Zero();
  for (const Simulation& k : simulations_) normal += k.sample->repeats * k.x * k.x.transpose();
  inverse_normal_ = normal.inverse();
}

void CalibratedFold::add(const LightSample& sample, bool narrow) {
  const Vector7 place = other_.frame().of(light_centre(sample.cascade, other_.settings().kind));
  simulations_.push_back({&sample, narrow, place, terms_at(place, narrow)});
}

CalibratedFold::Correction CalibratedFold::correction(double later) const {
  return {residual_fit(later),
          (mean_residual(later + time_step) - mean_residual(later - time_step)) / (2 * time_step)};
}

CalibratedFold::Spread CalibratedFold::spread() const {
  const TermsFit fit = residual_fit(0);
  const Eigen::LDLT<Matrix7> variance(weights_.poisson_variance());
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

CalibratedFold::Score CalibratedFold::score(const Vector7& p, const Correction& correction) const {
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
      light * (correction.fit.rightCols<regression_coordinates>() - correction.by_time * valley_.transpose());
  result.slope.col(5) += light * correction.by_time;
  result.slope.col(6) += level;
  return result;
}

Matrix7 CalibratedFold::simulation_variance(const Vector7& p) const {
  const Terms x = terms_at(p, true);
  const double events = data_.repeats() * std::exp(p(6));
  return events * events * x.dot(inverse_normal_ * x) * weights_.poisson_variance();
}

// Simulated less expected sums of one event, of a simulation arriving `later`.
Vector7 CalibratedFold::residual(const Simulation& k, double later) const {
  Vector7 p = k.place;
  p(5) = later + valley_.dot(p.head<regression_coordinates>());
  const auto gaps = simulation_gaps(data_, other_, *k.sample, p, k.sample->cascade.time + p(5) - k.place(5));
  Vector7 sum = Vector7::Zero();
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Emulator::Bin& bin = other_.bins()[i];
    if (!bin.saturated && !bin.left_out) sum += gaps[i] * weights_[i];
  }
  return sum;
}

CalibratedFold::TermsFit CalibratedFold::residual_fit(double later) const {
  TermsFit sum = TermsFit::Zero();
  for (const Simulation& k : simulations_) sum += k.sample->repeats * residual(k, later) * k.x.transpose();
  return sum * inverse_normal_;
}

Vector7 CalibratedFold::mean_residual(double later) const {
  Vector7 sum = Vector7::Zero();
  double repeats = 0;
  for (const Simulation& k : simulations_) {
    sum += k.sample->repeats * residual(k, later);
    repeats += k.sample->repeats;
  }
  return sum / repeats;
}

}  // namespace floe

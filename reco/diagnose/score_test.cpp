#include "reco/diagnose/score_test.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace floe {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd combined(const Suspect& suspect, const VectorXd& columns) {
  VectorXd sums = VectorXd::Zero(static_cast<Eigen::Index>(suspect.amplitudes.size()));
  for (Eigen::Index i = 0; i < sums.size(); ++i)
    for (const auto& [column, weight] : suspect.amplitudes[static_cast<std::size_t>(i)])
      sums(i) += weight * columns(column);
  return sums;
}

// Of the columns of one suspect with those of another.
MatrixXd combined(const Suspect& a, const Suspect& b, const MatrixXd& columns) {
  MatrixXd sums(static_cast<Eigen::Index>(a.amplitudes.size()), static_cast<Eigen::Index>(b.amplitudes.size()));
  for (Eigen::Index i = 0; i < sums.rows(); ++i)
    for (Eigen::Index k = 0; k < sums.cols(); ++k) {
      double sum = 0;
      for (const auto& [row, weight] : a.amplitudes[static_cast<std::size_t>(i)])
        for (const auto& [column, other] : b.amplitudes[static_cast<std::size_t>(k)])
          sum += weight * other * columns(row, column);
      sums(i, k) = sum;
    }
  return sums;
}

// Combinations of amplitudes that change light by something: columns of the result. `light`: counts of all
// bins.
MatrixXd known_directions(const MatrixXd& information, double light) {
  constexpr double least = 1e-4;     // of the largest
  constexpr double hardly = 1e-9;    // mean square of the relative change of light
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(information);
  const VectorXd& values = parts.eigenvalues();  // rising
  const double limit = std::max(least * values.maxCoeff(), hardly * light);
  const Eigen::Index unknown = (values.array() <= limit).count();
  return parts.eigenvectors().rightCols(values.size() - unknown);
}

// Inverse within these directions, 0 in all others.
MatrixXd inverse(const MatrixXd& symmetric, const MatrixXd& directions) {
  const MatrixXd inside = directions.transpose() * symmetric * directions;
  return directions * inside.ldlt().solve(directions.transpose());
}

// A suspect with what its test needs, worked out once.
struct Tested {
  const Suspect* suspect;
  MatrixXd information, inverse_information, inverse_noise;
  VectorXd low, high;  // limits of the amplitudes
  double light;        // counts of all bins

  VectorXd amplitudes(const VectorXd& gap) const { return inverse_information * gap; }
  bool allowed(const VectorXd& at) const {
    return ((at - low).array() >= 0).all() && ((high - at).array() >= 0).all();
  }
  double size(const VectorXd& at) const {
    return std::sqrt(std::max(0.0, at.dot(information * at)) / light);
  }
  double gain(const VectorXd& columns, double floor) const {
    const VectorXd gap = combined(*suspect, columns);
    const VectorXd at = amplitudes(gap);
    if (!allowed(at) || size(at) < floor) return 0;
    return gap.dot(inverse_noise * gap) / 2;
  }
};

// Amplitudes of one-sided parameters must not leave their limits: there is no ice with less than no
// birefringence.
void limit(const Suspect& suspect, const std::vector<IceParameter>& parameters, const Survey& survey,
           Tested& tested) {
  const auto size = static_cast<Eigen::Index>(suspect.amplitudes.size());
  constexpr double slack = 1e-9;
  tested.low = VectorXd::Constant(size, -suspect.largest);
  tested.high = VectorXd::Constant(size, suspect.largest);
  if (!suspect.place.empty()) return;
  for (Eigen::Index i = 0; i < size; ++i) {
    const int column = suspect.amplitudes[static_cast<std::size_t>(i)].front().first;
    const IceParameter& p = parameters[survey.columns[static_cast<std::size_t>(column)].parameter];
    if (p.start <= p.low) tested.low(i) = -slack;
    if (p.start >= p.high) tested.high(i) = slack;
  }
}

// Large gains have probability n exp(-gain); n from the upper tenth of the draws.
double ln_number(std::vector<double> gains) {
  constexpr double tail = 0.1;
  std::sort(gains.begin(), gains.end());
  const auto index = static_cast<std::size_t>((1 - tail) * static_cast<double>(gains.size()));
  return std::log(tail) + gains[std::min(index, gains.size() - 1)];
}
double ln_probability(double gain, double ln_number) {
  return std::min(0.0, ln_number - gain);
}

std::vector<Tested> prepare(const Survey& survey, const std::vector<Suspect>& suspects,
                            const std::vector<IceParameter>& parameters) {
  double light = 0;
  for (const SurveyRun& run : survey.runs) light += (run.trust * run.expected).sum();
  std::vector<Tested> tested;
  for (const Suspect& suspect : suspects) {
    Tested t;
    t.suspect = &suspect;
    t.light = light;
    t.information = combined(suspect, suspect, survey.information);
    const MatrixXd directions = known_directions(t.information, light);
    if (directions.cols() == 0) continue;  // no light would show it
    t.inverse_information = inverse(t.information, directions);
    t.inverse_noise = inverse(combined(suspect, suspect, survey.noise), directions);
    limit(suspect, parameters, survey, t);
    tested.push_back(std::move(t));
  }
  return tested;
}

// Correlation of the change of light that `a` makes with the most alike that `b` can make.
double likeness(const Score& a, const Tested& of_a, const Tested& b, const MatrixXd& information) {
  const MatrixXd cross = combined(*b.suspect, *of_a.suspect, information);
  const VectorXd along = cross * a.amplitudes;
  const double own = a.amplitudes.dot(of_a.information * a.amplitudes);
  if (!(own > 0)) return 0;
  return std::clamp(std::sqrt(std::max(0.0, along.dot(b.inverse_information * along)) / own), 0.0, 1.0);
}

}  // namespace

ScoreTest test_scores(const Survey& survey, const std::vector<Suspect>& suspects,
                      const std::vector<IceParameter>& parameters, double floor, int draws,
                      std::uint64_t seed) {
  const std::vector<Tested> tested = prepare(survey, suspects, parameters);
  // By effect: the largest gain of any of its suspects, in the data and in each draw.
  const VectorXd gap = gap_of(survey, measured_counts(survey));
  std::map<std::string, const Tested*> best;
  std::map<std::string, double> gain;
  for (const Tested& t : tested) {
    const double of_data = t.gain(gap, floor);
    const std::string& effect = t.suspect->effect;
    if (!best.count(effect) || of_data > gain[effect]) best[effect] = &t, gain[effect] = of_data;
  }
  std::map<std::string, std::vector<double>> drawn;
  for (auto& [effect, t] : best) drawn[effect].assign(static_cast<std::size_t>(draws), 0);
#pragma omp parallel for schedule(dynamic)
  for (int d = 0; d < draws; ++d) {
    const VectorXd of_draw = gap_of(survey, drawn_counts(survey, seed, static_cast<std::uint64_t>(d)));
    for (const Tested& t : tested) {
      double& most = drawn.at(t.suspect->effect)[static_cast<std::size_t>(d)];
      most = std::max(most, t.gain(of_draw, 0));
    }
  }

  ScoreTest result;
  std::map<std::string, double> number;
  for (const auto& [effect, t] : best) {
    number[effect] = ln_number(drawn[effect]);
    EffectScore score;
    score.best = {*t->suspect, gain[effect], t->amplitudes(combined(*t->suspect, gap)), 0};
    score.best.size = t->size(score.best.amplitudes);
    score.ln_p = ln_probability(gain[effect], number[effect]);
    result.effects.push_back(std::move(score));
  }
  std::stable_sort(result.effects.begin(), result.effects.end(),
                   [](const EffectScore& a, const EffectScore& b) { return a.ln_p < b.ln_p; });
  // The least of all effects' probabilities, in each draw.
  std::vector<double> least(static_cast<std::size_t>(draws), 0);
  for (const auto& [effect, gains] : drawn)
    for (std::size_t d = 0; d < least.size(); ++d)
      least[d] = std::max(least[d], gains[d] - number[effect]);
  result.p_value = std::exp(ln_probability(-result.effects.front().ln_p, ln_number(least)));
  const EffectScore& first = result.effects.front();
  const Tested& of_first = *best.at(first.best.suspect.effect);
  for (EffectScore& effect : result.effects) {
    // Of all its places, the one that imitates best.
    for (const Tested& t : tested)
      if (t.suspect->effect == effect.best.suspect.effect)
        effect.likeness =
            std::max(effect.likeness, likeness(first.best, of_first, t, survey.information));
  }
  return result;
}

double ln_tail_probability(double gain, const std::vector<double>& drawn) {
  return ln_probability(gain, ln_number(drawn));
}

double sigmas_of(double ln_p) {
  // erfc(s / sqrt 2) = p, by Newton's way in the logarithm; for large s its asymptotic form.
  if (ln_p >= 0) return 0;
  double s = std::sqrt(std::max(0.0, -2 * ln_p));
  for (int i = 0; i < 50; ++i) {
    const bool far = s > 30;
    const double value = far ? -s * s / 2 - std::log(s) + std::log(2 / std::sqrt(2 * std::numbers::pi))
                             : std::log(std::erfc(s / std::numbers::sqrt2));
    const double slope = far ? -s - 1 / s
                             : -std::sqrt(2 / std::numbers::pi) * std::exp(-s * s / 2 - value);
    const double step = (ln_p - value) / slope;
    s = std::max(1e-9, s + step);
    if (std::abs(step) < 1e-10) break;
  }
  return s;
}

}  // namespace floe

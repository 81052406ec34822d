#include "reco/diagnose/score_test.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "propagation/engine/threads.h"
#include "reco/validation/two_sample_tests.h"

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
  MatrixXd sums(static_cast<Eigen::Index>(a.amplitudes.size()),
                static_cast<Eigen::Index>(b.amplitudes.size()));
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

// Combinations of amplitudes that change light by something, in columns, and those that do not; large
// changes all.
struct Directions {
  MatrixXd known, unknown;
};
// `large`: a large change of each amplitude; `light`: counts of all bins.
Directions directions(const MatrixXd& information, const VectorXd& large, double light) {
  constexpr double least = 1e-4;   // of the largest
  constexpr double hardly = 1e-9;  // mean square of the relative change of light
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(large.asDiagonal() * information * large.asDiagonal());
  const VectorXd& values = parts.eigenvalues();  // rising
  const double limit = std::max(least * values.maxCoeff(), hardly * light);
  const Eigen::Index unknown = (values.array() <= limit).count();
  const MatrixXd all = large.asDiagonal() * parts.eigenvectors();
  return {all.rightCols(values.size() - unknown), all.leftCols(unknown)};
}

// By amplitude of the suspect.
VectorXd large_changes(const Suspect& suspect, const std::vector<IceParameter>& parameters,
                       const Survey& survey) {
  VectorXd large(static_cast<Eigen::Index>(suspect.amplitudes.size()));
  for (Eigen::Index i = 0; i < large.size(); ++i) {
    const int first = suspect.amplitudes[static_cast<std::size_t>(i)].front().first;
    const SurveyColumn& column = survey.columns[static_cast<std::size_t>(first)];
    large(i) = column.kind == SurveyColumn::Kind::parameter ? parameters[column.parameter].scale
                                                            : large_change(column.kind);
  }
  return large;
}

// Inverse within these directions, 0 in all others.
MatrixXd inverse(const MatrixXd& symmetric, const MatrixXd& directions) {
  const MatrixXd inside = directions.transpose() * symmetric * directions;
  return directions * inside.ldlt().solve(directions.transpose());
}

// Amplitudes of one-sided parameters must not leave their limits: there is no ice with less than no
// birefringence.
void limit(const Suspect& suspect, const std::vector<IceParameter>& parameters, const Survey& survey,
           TestedSuspect& tested) {
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

// Large surprises have probability n exp(-surprise); n from the upper tenth of the draws.
double ln_number(std::vector<double> surprises) {
  constexpr double tail = 0.1;
  std::sort(surprises.begin(), surprises.end());
  const auto index = static_cast<std::size_t>((1 - tail) * static_cast<double>(surprises.size()));
  return std::log(tail) + surprises[std::min(index, surprises.size() - 1)];
}
double ln_probability(double surprise, double ln_number) {
  return surprise > 0 ? std::min(0.0, ln_number - surprise) : 0;
}

// The gain that surprises so much.
double gain_of(double surprise, int degrees) {
  double low = 0, high = 1;
  const auto of = [&](double gain) { return -ln_chi_square_probability(2 * gain, degrees); };
  while (of(high) < surprise) low = high, high *= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (of(middle) < surprise ? low : high) = middle;
  }
  return (low + high) / 2;
}

std::vector<TestedSuspect> prepare(const Survey& survey, const std::vector<Suspect>& suspects,
                                   const std::vector<IceParameter>& parameters) {
  double light = 0;
  for (const SurveyRun& run : survey.runs) light += (run.trust * run.expected).sum();
  std::vector<TestedSuspect> tested;
  for (const Suspect& suspect : suspects) {
    TestedSuspect t;
    t.suspect = &suspect;
    t.light = light;
    t.information = combined(suspect, suspect, survey.information);
    const auto [known, unknown] =
        directions(t.information, large_changes(suspect, parameters, survey), light);
    if (known.cols() == 0) continue;  // no light would show it
    t.degrees = static_cast<int>(known.cols());
    t.inverse_information = inverse(t.information, known);
    t.noise = combined(suspect, suspect, survey.noise);
    t.inverse_noise = inverse(t.noise, known);
    t.unknown = unknown.rowwise().squaredNorm();
    limit(suspect, parameters, survey, t);
    tested.push_back(std::move(t));
  }
  return tested;
}

constexpr std::size_t leaders_compared = 6;  // with each other

// Of slopes that are mostly noise, nobody knows what they are like.
constexpr double least_known = 0.25;

// Of the change of light that a suspect makes, the most alike that another can make.
struct Imitation {
  double likeness = 0;  // correlation
  VectorXd amplitudes;
};

Imitation imitation(const Score& a, const TestedSuspect& of_a, const TestedSuspect& b,
                    const MatrixXd& information) {
  const VectorXd along = combined(*b.suspect, *of_a.suspect, information) * a.amplitudes;
  const double own = a.amplitudes.dot(of_a.information * a.amplitudes);
  if (!(own > 0) || b.known_share() < least_known) return {0, VectorXd::Zero(along.size())};
  const VectorXd amplitudes = b.inverse_information * along;
  return {std::clamp(std::sqrt(std::max(0.0, along.dot(amplitudes)) / own), 0.0, 1.0), amplitudes};
}

// The most likely amplitudes between limits, one coordinate after another, from `at`: the least of
// a H a / 2 - a g.
VectorXd within_limits(const MatrixXd& H, const VectorXd& g, const VectorXd& low, const VectorXd& high,
                       const VectorXd& at) {
  constexpr int sweeps = 30;
  VectorXd a = at.cwiseMax(low).cwiseMin(high);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (Eigen::Index i = 0; i < a.size(); ++i)
      if (H(i, i) > 0) a(i) = std::clamp(a(i) + (g(i) - H.row(i).dot(a)) / H(i, i), low(i), high(i));
  return a;
}

// By column of a survey with so many.
VectorXd spread_over_columns(const Suspect& suspect, const VectorXd& amplitudes, Eigen::Index columns) {
  VectorXd spread = VectorXd::Zero(columns);
  for (Eigen::Index i = 0; i < amplitudes.size(); ++i)
    for (const auto& [column, weight] : suspect.amplitudes[static_cast<std::size_t>(i)])
      spread(column) += weight * amplitudes(i);
  return spread;
}

}  // namespace

VectorXd TestedSuspect::amplitudes(const VectorXd& columns) const {
  return amplitudes(columns, VectorXd::Zero(low.size()));
}
VectorXd TestedSuspect::amplitudes(const VectorXd& columns, const VectorXd& around) const {
  const VectorXd gap = combined(*suspect, columns) + information * around;
  const VectorXd at = inverse_information * gap;
  if (((at - low).array() >= 0).all() && ((high - at).array() >= 0).all()) return at;
  const MatrixXd weight = information * inverse_noise;
  return within_limits(weight * information, weight * gap, low, high, at);
}
VectorXd TestedSuspect::errors() const {
  const VectorXd known = (inverse_information * noise * inverse_information).diagonal().cwiseMax(0);
  return (known + unknown).cwiseSqrt();
}
double TestedSuspect::size(const VectorXd& at) const {
  return std::sqrt(std::max(0.0, at.dot(information * at)) / light);
}
double TestedSuspect::gain(const VectorXd& columns, double floor) const {
  const VectorXd gap = combined(*suspect, columns), at = amplitudes(columns);
  if (size(at) < floor) return 0;
  const VectorXd expected = information * at;
  return std::max(0.0, expected.dot(inverse_noise * (gap - expected / 2)));
}
double TestedSuspect::surprise(double gain) const {
  return -ln_chi_square_probability(2 * gain, degrees);
}
double TestedSuspect::known_share() const {
  return (inverse_noise * information).trace() / static_cast<double>(information.rows());
}
double TestedSuspect::expected_gain(const VectorXd& at) const {
  const VectorXd gap = information * at;
  return gap.dot(inverse_noise * gap) / 2;
}

ScoreTester::ScoreTester(const Survey& survey, const std::vector<Suspect>& suspects,
                         const std::vector<IceParameter>& parameters, const Draws& draws)
    : survey_(survey), tested_(prepare(survey, suspects, parameters)) {
  const auto number = static_cast<std::size_t>(draws.count);
  for (const TestedSuspect& t : tested_) drawn_[t.suspect->effect].assign(number, 0);
#pragma omp parallel for schedule(dynamic) num_threads(thread_count(draws.threads))
  for (std::size_t d = 0; d < number; ++d) {
    const VectorXd gap = gap_of(survey_, drawn_counts(survey_, draws.seed, d));
    for (const TestedSuspect& t : tested_) {
      double& most = drawn_.at(t.suspect->effect)[d];
      most = std::max(most, t.surprise(t.gain(gap, 0)));
    }
  }
  // The least of all effects' probabilities, in each draw.
  std::vector<double> least(number, 0);
  for (const auto& [effect, surprises] : drawn_) {
    ln_number_[effect] = ln_number(surprises);
    for (std::size_t d = 0; d < number; ++d)
      least[d] = std::max(least[d], -ln_probability(surprises[d], ln_number_[effect]));
  }
  ln_number_of_all_ = ln_number(least);
}

double ScoreTester::gain_of_significance(const TestedSuspect& suspect, double sigmas) const {
  return gain_of(ln_number_.at(suspect.suspect->effect) - ln_p_of(sigmas), suspect.degrees);
}

double ScoreTester::gain_to_be_named(const TestedSuspect& suspect, double alpha) const {
  return gain_of(ln_number_.at(suspect.suspect->effect) + ln_number_of_all_ - std::log(alpha),
                 suspect.degrees);
}

Score ScoreTester::score_of(const TestedSuspect& tested, const VectorXd& gap, double floor) const {
  const VectorXd amplitudes = tested.amplitudes(gap);
  return {*tested.suspect, tested.gain(gap, floor), amplitudes, tested.errors(), tested.size(amplitudes)};
}

std::optional<Score> ScoreTester::elsewhere(const Score& best, const VectorXd& gap, double floor) const {
  constexpr double nearly = 0.6;  // of the best gain
  const TestedSuspect* most = nullptr;
  double gain = nearly * best.gain;
  for (const TestedSuspect& t : tested_)
    if (t.suspect->effect == best.suspect.effect && !is_same_place(t.suspect->place, best.suspect.place))
      if (const double own = t.gain(gap, floor); own > gain) most = &t, gain = own;
  if (!most) return {};
  return score_of(*most, gap, floor);
}

const EffectScore& ScoreTest::of(const std::string& effect) const {
  return *std::ranges::find_if(effects,
                               [&](const EffectScore& score) { return score.best.suspect.effect == effect; });
}

ScoreTest ScoreTester::test(const SurveyCounts& counts, double floor) const {
  const VectorXd gap = gap_of(survey_, counts);
  // By effect, the suspect that surprises the most.
  std::map<std::string, const TestedSuspect*> best;
  std::map<std::string, double> surprise;
  for (const TestedSuspect& t : tested_) {
    const double surprised = t.surprise(t.gain(gap, floor));
    const std::string& effect = t.suspect->effect;
    if (!best.count(effect) || surprised > surprise[effect]) best[effect] = &t, surprise[effect] = surprised;
  }
  ScoreTest result;
  for (const auto& [effect, t] : best) {
    EffectScore score;
    score.best = score_of(*t, gap, floor);
    score.ln_p = ln_probability(surprise[effect], ln_number_.at(effect));
    score.elsewhere = elsewhere(score.best, gap, floor);
    result.effects.push_back(std::move(score));
  }
  if (result.effects.empty()) return result;
  std::stable_sort(result.effects.begin(), result.effects.end(),
                   [](const EffectScore& a, const EffectScore& b) { return a.ln_p < b.ln_p; });
  const EffectScore& first = result.effects.front();
  result.p_value = std::exp(ln_probability(-first.ln_p, ln_number_of_all_));
  for (EffectScore& effect : result.effects)
    effect.likeness = likeness(first.best, effect.best.suspect.effect);
  result.effects.front().likeness = 1;  // whatever its slopes are

  const auto leaders =
      static_cast<Eigen::Index>(std::min<std::size_t>(leaders_compared, result.effects.size()));
  result.likeness = MatrixXd::Identity(leaders, leaders);
  for (Eigen::Index i = 0; i < leaders; ++i)
    for (Eigen::Index j = 0; j < leaders; ++j)
      if (i != j)
        result.likeness(i, j) = likeness(result.effects[static_cast<std::size_t>(i)].best,
                                         result.effects[static_cast<std::size_t>(j)].best.suspect.effect);
  return result;
}

// Of all places of the other, the one that imitates best.
double ScoreTester::likeness(const Score& score, const std::string& other) const {
  const TestedSuspect& own = tested(score.suspect);
  double most = 0;
  for (const TestedSuspect& t : tested_)
    if (t.suspect->effect == other)
      most = std::max(most, imitation(score, own, t, survey_.information).likeness);
  return most;
}

const TestedSuspect& ScoreTester::tested(const Suspect& suspect) const {
  return *std::find_if(tested_.begin(), tested_.end(), [&](const TestedSuspect& t) {
    return t.suspect->effect == suspect.effect && t.suspect->place == suspect.place;
  });
}

VectorXd ScoreTester::difference(const Score& score, const std::string& other) const {
  const TestedSuspect& own = tested(score.suspect);
  VectorXd imitated = VectorXd::Zero(survey_.information.cols());
  double most = 0;
  for (const TestedSuspect& t : tested_) {
    if (t.suspect->effect != other) continue;
    const Imitation by_it = imitation(score, own, t, survey_.information);
    if (by_it.likeness <= most) continue;
    most = by_it.likeness;
    imitated = spread_over_columns(*t.suspect, by_it.amplitudes, imitated.size());
  }
  return spread_over_columns(score.suspect, score.amplitudes, imitated.size()) - imitated;
}

double ln_tail_probability(double surprise, const std::vector<double>& drawn) {
  return ln_probability(surprise, ln_number(drawn));
}

double ln_p_of(double sigmas) {
  constexpr double far = 30;  // where its asymptotic form serves
  if (sigmas > far)
    return -sigmas * sigmas / 2 - std::log(sigmas) + std::log(2 / std::sqrt(2 * std::numbers::pi));
  return std::log(std::erfc(sigmas / std::numbers::sqrt2));
}

double sigmas_of(double ln_p) {
  // Newton's way in the logarithm.
  if (ln_p >= 0) return 0;
  double s = std::sqrt(std::max(0.0, -2 * ln_p));
  for (int i = 0; i < 50; ++i) {
    const double value = ln_p_of(s);
    const double slope = -std::sqrt(2 / std::numbers::pi) * std::exp(-s * s / 2 - value);
    const double step = (ln_p - value) / slope;
    s = std::max(1e-9, s + step);
    if (std::abs(step) < 1e-10) break;
  }
  return s;
}

}  // namespace floe

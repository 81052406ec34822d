// Which change of the model would explain the data best? The score test of every suspect at once, calibrated
// on light that is drawn from the model itself.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reco/diagnose/survey.h"
#include "reco/diagnose/suspects.h"

namespace floe {

struct Score {
  Suspect suspect;
  double gain = 0;              // expected of -ln L, by the best amplitudes
  Eigen::VectorXd amplitudes;   // the best, to first order
  Eigen::VectorXd errors = {};  // of the amplitudes
  // Light's root mean square relative change at these amplitudes, weighted by counts.
  double size = 0;
};

// The best suspect of one effect, judged among all places that were tried.
struct EffectScore {
  Score best;
  // Logarithm of the probability of as much gain from any of its suspects if nothing is missing.
  double ln_p = 0;
  // Share of the best suspect's change of light that this one can imitate: correlation, brightness and time
  // zero of runs apart.
  double likeness = 0;
  // Of the suspects at other places (is_same_place) the best, where it explains nearly as much: a flasher
  // that has moved looks much like the nearest string moved the other way.
  std::optional<Score> elsewhere = {};
};

struct ScoreTest {
  std::vector<EffectScore> effects;  // the least ln_p first; likeness is with the first
  // Of the first few with each other: how much of what the row's best suspect changes the column's effect can
  // imitate. 1 on the diagonal.
  Eigen::MatrixXd likeness;
  double p_value = 1;  // of the first, for everything tried

  const EffectScore& of(const std::string& effect) const;  // one of the effects
};

// A suspect with what its test needs.
struct TestedSuspect {
  const Suspect* suspect;
  Eigen::MatrixXd information, noise, inverse_information, inverse_noise;
  Eigen::VectorXd unknown;    // squared errors of the amplitudes along what light does not show
  Eigen::VectorXd low, high;  // limits of the amplitudes
  double light;               // counts of all bins
  int degrees;                // combinations of amplitudes that light shows

  // By the gaps of all columns (gap_of): the most likely within the limits. `around`: of what light was
  // expected with; none: the survey's model.
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& columns) const;
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& columns, const Eigen::VectorXd& around) const;
  Eigen::VectorXd errors() const;  // of the amplitudes
  double size(const Eigen::VectorXd& amplitudes) const;
  double gain(const Eigen::VectorXd& columns, double floor) const;
  // -ln of the probability of so much gain by chance, if this were the only suspect.
  double surprise(double gain) const;
  // How much of what its slopes should tell they do tell; below 1 by the noise of the simulation and of the
  // slopes themselves.
  double known_share() const;
  // Expected of light that has these amplitudes.
  double expected_gain(const Eigen::VectorXd& amplitudes) const;
};

// Worked out once for a survey, it judges any counts.
class ScoreTester {
 public:
  // Keeps references to survey and suspects. `draws`: of the calibration.
  ScoreTester(const Survey& survey, const std::vector<Suspect>& suspects,
              const std::vector<IceParameter>& parameters, const Draws& draws);

  // Effects that change light by less than `floor` are not told from small differences between programs:
  // their gain is 0.
  ScoreTest test(const SurveyCounts& counts, double floor) const;
  // By column of the survey: what this changes at its best amplitudes, less the most alike that the other
  // effect can change, of all its places.
  Eigen::VectorXd difference(const Score& score, const std::string& other) const;
  const std::vector<TestedSuspect>& suspects() const { return tested_; }
  const TestedSuspect& tested(const Suspect& suspect) const;  // one of suspects()
  // Gain at which its effect is named with this probability for everything tried.
  double gain_to_be_named(const TestedSuspect& suspect, double alpha) const;
  // Gain at which its effect has this significance [standard deviations] for all its places.
  double gain_of_significance(const TestedSuspect& suspect, double sigmas) const;

 private:
  Score score_of(const TestedSuspect& tested, const Eigen::VectorXd& gap, double floor) const;
  std::optional<Score> elsewhere(const Score& best, const Eigen::VectorXd& gap, double floor) const;
  double likeness(const Score& score, const std::string& other) const;

  const Survey& survey_;
  std::vector<TestedSuspect> tested_;
  // By effect, the largest surprise of any of its suspects in each draw, and what follows from them.
  std::map<std::string, std::vector<double>> drawn_;
  std::map<std::string, double> ln_number_;
  double ln_number_of_all_ = 0;
};

// Logarithm of the probability of at least this surprise, given those of draws: beyond most of them it falls
// exponentially, whatever surprises.
double ln_tail_probability(double surprise, const std::vector<double>& drawn);

// Standard deviations of a Gaussian that are exceeded, up or down, with this probability.
double sigmas_of(double ln_p);
double ln_p_of(double sigmas);

}  // namespace floe

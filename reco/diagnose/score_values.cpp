#include "reco/diagnose/score_values.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

// What is expected becomes this light, as bright as the data.
void expect(const LightInBins& light, const Survey& survey, SurveyCounts& counts) {
  for (std::size_t r = 0; r < counts.size(); ++r) {
    const double brightness = counts[r].data.sum() / light[r].sum();
    for (auto& half : counts[r].simulated) half = light[r] * (brightness / (2 * survey.runs[r].scale));
  }
}

}  // namespace

ScoreValues beyond_first_order(const Survey& survey, const TestedSuspect& suspect, SurveyCounts counts,
                               const Score& score,
                               const std::function<LightInBins(const Eigen::VectorXd&)>& light) {
  constexpr int rounds = 6;
  constexpr double settled = 0.1;          // errors
  constexpr double least = 0.5, most = 5;  // change of light, in units of what the slopes say
  const auto size = [&](const Eigen::VectorXd& step) { return step.dot(suspect.information * step); };
  Eigen::VectorXd best = Eigen::VectorXd::Zero(score.amplitudes.size()), at = score.amplitudes;
  Eigen::VectorXd missing = at;  // at the best, by the slopes
  double steepness = 1;
  for (int round = 0; round < rounds; ++round) {
    expect(light(at), survey, counts);
    const Eigen::VectorXd step = at - best, now_missing = suspect.amplitudes(gap_of(survey, counts), at) - at;
    if (size(now_missing) > size(missing)) {  // too far
      at = best + step / 2;
      continue;
    }
    if (size(step) > 0)
      steepness =
          std::clamp((missing - now_missing).dot(suspect.information * step) / size(step), least, most);
    best = at;
    missing = now_missing;
    if ((missing.array().abs() < settled * steepness * score.errors.array()).all()) break;
    at = best + missing / steepness;
  }
  if (best.isZero()) return {score.amplitudes, score.errors};  // nothing was better than no change at all
  // Counts, and with them their squared noise, change as light does.
  return {best, score.errors / std::sqrt(steepness)};
}

}  // namespace floe

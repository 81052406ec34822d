// The last step of a search: calibrations of the score until one of them moves no further.
#include <algorithm>
#include <cmath>
#include <optional>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/average_place.h"
#include "reco/direct_fit/design.h"
#include "reco/direct_fit/search.h"

namespace floe {
namespace {

constexpr std::size_t most_calibrations = 8;
constexpr int most_rounds_without_score = 5;
constexpr double acceptable_pull = 1.5;  // of the last step of all
// New photons even where there are enough already, and what weights may lose (see InformationBound) before
// they are taught with more photons, up to so many times the usual.
constexpr double least_fresh_share = 0.2, acceptable_loss = 1.3, most_training = 6;
constexpr double acceptable_dispersion = 1.8, least_reach = 0.3;
// Photons of the last calibration, times the usual; as many more for the weights as they lose more than this.
constexpr double last_training = 1.5, last_judging = 2.5, last_loss = 1.1;
// Photons that judge, in each fold.
constexpr PhotonNeed usual_judging{5, 2e6, 2e7};
constexpr double close_enough = 1.2;  // last steps, in steps of the narrow design
// [photoelectrons] expected: hardly any module stays dark.
constexpr double surely_seen = 4;

// What weights lose falls with the photons that teach them.
double training_to_lose(double acceptable, double loss, double training) {
  return training * (loss - 1) / (acceptable - 1);
}

}  // namespace

// After all calibrations, when none but the first, on their way, led out of one minimum.
std::optional<AveragePlace> Search::walked_about(std::span<const LightCentre> visited) {
  constexpr std::size_t on_their_way = 2;
  if (visited.size() < most_calibrations) return std::nullopt;
  const std::span<const LightCentre> places = visited.subspan(on_their_way);
  const AveragePlace average = average_of(places);
  const bool together = std::all_of(places.begin(), places.end(), [&](const LightCentre& place) {
    return same_minimum(place, average.light);
  });
  return together ? std::optional(average) : std::nullopt;
}

Search::End Search::finish(const RoundEnd& rough, std::span<const End> known) {
  End end;
  end.light = rough.light;
  const Vector7& errors = rough.errors;
  if (!errors.allFinite()) {
    end.trouble = "the data do not determine all seven numbers";
    end.covariance.setConstant(std::numeric_limits<double>::infinity());
    return end;
  }
  end.need.errors = {errors.head<3>().norm(), errors.segment<2>(3).norm()};
  end.unsolved = data_.charge() < worthwhile_charge;
  std::optional<End> found;  // the last solution that stayed near its calibration
  std::vector<LightCentre> visited;
  for (std::size_t i = 0; i < most_calibrations && !end.converged && !end.unsolved; ++i) {
    calibrate(end);
    if (std::any_of(known.begin(), known.end(), [&](const End& other) {
          return !other.unsolved && same_minimum(end.light, other.light);
        }))
      return end;
    if (end.pull < acceptable_pull) found = end;
    visited.push_back(end.light);
  }
  if (!end.converged && found) end = *found;
  end.unsolved |= !end.converged && !found;
  if (end.unsolved)
    end_without_solution(end, visited);
  else
    end.converged = true;
  return end;
}

void Search::end_without_solution(End& end, std::span<const LightCentre> visited) {
  end.calibration.reset();
  if (const std::optional<AveragePlace> average = walked_about(visited)) {
    end.light = average->light;
    end.covariance = average->scatter;
    end.simulation_covariance.reset();
    end.converged = true;
    return;
  }
  // Too little light for the score: the emulator's own minimum and curvature are what is left.
  Stage wide = calibration_stages(data_, end.light, end.need.errors, end.need.reach, options_.oversize).wide;
  wide.photons = photons_for(cascade_of(end.light, options_.kind), wide.oversize, {300, 2e6, 2e7});
  const RoundEnd last = settle(end.light, wide, most_rounds_without_score, true);
  end.light = last.light;
  end.covariance = data_.charge_dispersion() * covariance_of(last.fit.information);
  end.simulation_covariance.reset();
  end.converged = has_settled(last, wide);
  if (!end.converged) end.trouble = "the data do not determine all seven numbers";
}

// The last calibration once more with more photons: what their noise adds to the errors is the largest share
// that the data do not make.
Search::End Search::refined(const End& end) {
  if (!end.calibration) return end;
  End last = end;
  double& training = last.need.training;
  training = std::clamp(training_to_lose(last_loss, end.weight_loss(), training),
                        std::max(training, last_training), most_training);
  last.need.judging = last_judging;
  calibrate(last);
  if (last.unsolved || !(last.pull < acceptable_pull)) return end;
  last.converged = true;
  return last;
}

// Simulations near by that have so many photons together: as many as are missing are made.
std::vector<const LightSample*> Search::enough(const LocalFrame& frame, Stage stage, double photons,
                                               Purpose purpose) {
  double known = 0;
  for (const LightSample* sample : near(frame, stage, purpose)) known += double(sample->propagated);
  stage.photons = std::max(photons - known, least_fresh_share * photons);
  simulate(frame, stage, purpose);
  return near(frame, stage, purpose);
}

// Two draws of a wide design with wide modules teach the weights, two narrow ones at the wanted oversize say
// what the weighted sums mean.
void Search::calibrate(End& end) {
  CalibrationNeed& need = end.need;
  const LocalFrame frame(end.light);
  const CascadeParameters here = cascade_of(end.light, options_.kind);
  const auto [wide, narrow] =
      calibration_stages(data_, end.light, need.errors, need.reach, options_.oversize);
  const double for_training = need.training * photons_for(here, wide.oversize, {100, 1e6, 1e7});
  const double for_judging = need.judging * photons_for(here, narrow.oversize, usual_judging);
  const std::vector<const LightSample*> training[2] = {
      enough(frame, wide, for_training, Purpose::first_emulator),
      enough(frame, wide, for_training, Purpose::second_emulator)};
  const std::vector<const LightSample*> fresh[2] = {
      enough(frame, narrow, for_judging, Purpose::first_judge),
      enough(frame, narrow, for_judging, Purpose::second_judge)};
  std::vector<const LightSample*> all = fresh[0];
  all.insert(all.end(), fresh[1].begin(), fresh[1].end());
  end.edges = arrival_edges(data_, frame, all, options_.kind, surely_seen);
  const auto calibration = std::make_shared<Calibration>(Calibration{
      data_.with_edges(arrival_edges(data_, frame, all, options_.kind)), need.errors.position, 0, {}, {}});
  end.calibration = calibration;
  auto& folds = calibration->folds;
  for (int fold = 0; fold < 2; ++fold)
    folds.push_back(
        {emulate(calibration->data, end.light, wide, training[fold]), training[fold], fresh[fold]});
  const ScoreSolution& solution = calibration->solution =
      solve_calibrated_score(calibration->data, std::span<const ScoreFold, 2>(folds), need.errors.position);
  if (!solution.converged && !solution.leaves) {
    end.unsolved = true;
    end.covariance.setConstant(std::numeric_limits<double>::infinity());
    return;
  }
  const bool inside = solution.step.head<3>().norm() < close_enough * narrow.position_step &&
                      solution.step.segment<2>(3).norm() < close_enough * narrow.direction_step;
  const bool smooth = solution.dispersion < acceptable_dispersion || need.reach <= least_reach;
  const bool enough_light = solution.weight_loss < acceptable_loss || need.training >= most_training;
  const bool stays = !inside && !enough_light;  // weights that lose so much do not say where to
  if (!stays) end.light = frame.at(solution.step);
  end.covariance = solution.covariance;
  end.simulation_covariance = solution.covariance - solution.data_covariance;
  const double scatter = calibration->excess_scatter =
      data_.charge_dispersion() - 1 + options_.data_widened * std::max(0.0, solution.dispersion - 1);
  if (scatter > 0) end.covariance += scatter * solution.data_covariance;
  const Vector7 found = solution.covariance.diagonal().cwiseSqrt();
  end.pull = solution.leaves || stays ? std::numeric_limits<double>::infinity()
                                      : solution.step.cwiseAbs().cwiseQuotient(found).maxCoeff();
  end.converged = solution.converged && (inside || end.pull < 1) && enough_light && smooth;
  result_.rounds.push_back({cascade_of(end.light, options_.kind), folds[0].emulator.neg_llh(solution.step),
                            narrow.position_step, narrow.direction_step, narrow.oversize, end.pull});
  if (!smooth) {  // simulations reach further than the emulator can follow
    need.reach = std::max(least_reach, 0.6 * need.reach);
    return;
  }
  if (!enough_light)
    need.training = std::min(
        most_training, std::max(1.5 * need.training,
                                training_to_lose(acceptable_loss, solution.weight_loss, need.training)));
  if (stays) return;
  // The emulators' errors, which a search begins with, may be far too small.
  const PlaceErrors now = place_errors(solution.data_covariance);
  need.errors.position = std::clamp(now.position, 0.5 * need.errors.position, 1.5 * need.errors.position);
  need.errors.direction = std::clamp(now.direction, 0.5 * need.errors.direction, 1.5 * need.errors.direction);
}

double Search::End::weight_loss() const {
  return calibration ? calibration->solution.weight_loss : std::numeric_limits<double>::infinity();
}

std::optional<ScoreLikelihood> Search::End::likelihood() const {
  if (!calibration || !calibration->solution.converged) return std::nullopt;
  return score_likelihood(calibration->data, std::span<const ScoreFold, 2>(calibration->folds),
                          calibration->solution, calibration->position_error, calibration->excess_scatter);
}

}  // namespace floe

#include "reco/diagnose/effect_fits.h"

#include <algorithm>

#include "reco/ice_fit/ice_point.h"

namespace floe {

namespace {

constexpr int rounds_of_fits = 4, rounds_of_layers = 5, rounds_of_rivals = 4;
// In units of a run's own simulation, for six runs. Fewer take less time, and what one tells wrongly the
// others do not set right.
constexpr double light_of_pairs = 0.5, light_of_first_round = 0.4;
constexpr double runs_of_these = 6;
constexpr double light_of_folds = 3;  // in units of other fits'
// Rivals are alike. Of each run, at least so many hits, or as many as these times the brightest run's: with
// dim data their own noise decides.
constexpr double hits_of_rivals = 6e4, light_of_rivals = 3;

double light_for(double runs, double light_for_six) {
  return std::clamp(light_for_six * runs_of_these / runs, light_for_six, 1.0);
}

double brightest_run(const FlasherData& data) {
  double most = 0;
  for (const RunData& run : data.runs) most = std::max(most, run.charge);
  return most;
}

}  // namespace

IceFit EffectFits::fit(const std::vector<IceParameter>& parameters, const Settled& settled) const {
  return fit(parameters, rounds_of_fits, settled);
}

IceFit EffectFits::fit_layers(const std::vector<IceParameter>& parameters) const {
  return fit(parameters, rounds_of_layers, {});
}

// The first round and slopes from pairs have enough light.
std::vector<FitWithout> EffectFits::fit_without(const std::vector<std::vector<char>>& left_out,
                                                const std::vector<IceParameter>& parameters) const {
  IceFitOptions asked = options(1);
  asked.light.light *= light_of_folds, asked.light.least_hits *= light_of_folds;
  asked.pair_light /= light_of_folds, asked.first_light /= light_of_folds;
  return fit_ice_without(base_, data_, parameters, left_out, asked, stages_.part());
}

IceFit EffectFits::fit_rivals(const std::vector<IceParameter>& parameters, const Settled& settled) const {
  IceFitOptions asked = options(rounds_of_rivals);
  asked.settled = settled;
  asked.light.least_hits =
      std::max(asked.light.least_hits, std::min(hits_of_rivals, light_of_rivals * brightest_run(data_)));
  return fit_ice(base_, data_, parameters, asked, stages_.part());
}

IceFitOptions EffectFits::options(int rounds) const {
  const double runs = static_cast<double>(data_.runs.size());
  IceFitOptions asked;
  static_cast<RunSettings&>(asked) = settings_;
  asked.most_rounds = rounds;
  asked.judged = false;  // all models are judged by the same light, elsewhere
  asked.pair_light = light_for(runs, light_of_pairs);
  asked.least_pair_hits = enough_pair_hits;
  asked.first_light = light_for(runs, light_of_first_round);
  return asked;
}

IceFit EffectFits::fit(const std::vector<IceParameter>& parameters, int rounds,
                       const Settled& settled) const {
  IceFitOptions asked = options(rounds);
  asked.settled = settled;
  return fit_ice(base_, data_, parameters, asked, stages_.part());
}

}  // namespace floe

#include "reco/diagnose/effect_fits.h"

#include <algorithm>

#include "reco/diagnose/light_by_runs.h"
#include "reco/ice_fit/ice_point.h"

namespace floe {

namespace {

constexpr int rounds_of_fits = 4, rounds_of_layers = 7, rounds_of_rivals = 4;
// For six runs, see light_by_runs.h: of pairs, in units of a run's own simulation, of the first round and of
// later ones, which remember what those before them saw, and of fits that leave runs out, in units of what
// the settings ask for.
constexpr double light_of_pairs = 0.5, light_of_first_round = 0.4, light_of_later_rounds = 0.6,
                 light_of_folds = 1.5, most_light_of_folds = 3;
// Rivals are alike. Of each run, at least so many hits, or as many as these times the brightest run's: with
// dim data their own noise decides.
constexpr double hits_of_rivals = 6e4, light_of_rivals = 3;

double brightest_run(const FlasherData& data) {
  double most = 0;
  for (const RunData& run : data.runs) most = std::max(most, run.charge);
  return most;
}

}  // namespace

IceFit EffectFits::fit(const std::vector<IceParameter>& parameters, const Settled& settled) const {
  IceFitOptions asked = options(rounds_of_fits);
  asked.settled = settled;
  return fit(parameters, asked);
}

IceFit EffectFits::fit_layers(const std::vector<IceParameter>& parameters) const {
  IceFitOptions asked = options(rounds_of_layers);
  asked.later_light = 1, asked.remembers = true;
  return fit(parameters, asked);
}

// The first round and slopes from pairs have enough light.
std::vector<FitWithout> EffectFits::fit_without(const std::vector<std::vector<char>>& left_out,
                                                const std::vector<IceParameter>& parameters) const {
  IceFitOptions asked = options(1);
  const double light = light_by_runs(data_.runs.size(), light_of_folds, most_light_of_folds);
  asked.light *= light;
  asked.pair_light /= light, asked.first_light /= light, asked.later_light = 1;
  return fit_ice_without(base_, data_, parameters, left_out, asked, stages_.part());
}

IceFit EffectFits::fit_rivals(const std::vector<IceParameter>& parameters, const Settled& settled) const {
  IceFitOptions asked = options(rounds_of_rivals);
  asked.settled = settled;
  asked.light.least_hits =
      std::max(asked.light.least_hits, std::min(hits_of_rivals, light_of_rivals * brightest_run(data_)));
  return fit(parameters, asked);
}

IceFitOptions EffectFits::options(int rounds) const {
  IceFitOptions asked;
  static_cast<RunSettings&>(asked) = settings_;
  asked.most_rounds = rounds;
  asked.judged = false;  // all models are judged by the same light, elsewhere
  asked.pair_light = light_by_runs(data_.runs.size(), light_of_pairs, 1);
  asked.least_pair_hits = enough_pair_hits;
  asked.first_light = light_by_runs(data_.runs.size(), light_of_first_round, 1);
  asked.later_light = light_by_runs(data_.runs.size(), light_of_later_rounds, 1);
  asked.remembers = asked.later_light < 1;  // otherwise a round has all the light that a fit needs
  return asked;
}

IceFit EffectFits::fit(const std::vector<IceParameter>& parameters, const IceFitOptions& asked) const {
  return fit_ice(base_, data_, parameters, asked, stages_.part());
}

}  // namespace floe

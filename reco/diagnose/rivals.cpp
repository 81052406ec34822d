#include "reco/diagnose/rivals.h"

#include <cmath>

namespace floe {

namespace {

constexpr double leading_share = 0.35;  // of the first's gain

}  // namespace

bool leads(const EffectScore& effect, const EffectScore& first) {
  constexpr double least_gain = 5;
  constexpr double by_chance = 0.01;  // for all its places
  return effect.best.gain >= leading_share * first.best.gain && effect.best.gain > least_gain &&
         effect.ln_p < std::log(by_chance);
}

bool is_alternative(const EffectScore& effect, const EffectScore& first, double gained, double left) {
  constexpr double nearly = 0.75, least = 0.6;
  const double explained = effect.likeness * effect.likeness, share = effect.best.gain / first.best.gain;
  const bool leaves_enough = gained * (1 - explained) <= left * explained;
  return is_inseparable(effect, first) || share >= nearly || (share >= least && leaves_enough);
}

bool waits(const EffectScore& effect, const EffectScore& first) {
  const double explained = effect.likeness * effect.likeness * first.best.gain;
  return leads(effect, first) && effect.best.gain - explained >= leading_share * first.best.gain;
}

bool is_inseparable(const EffectScore& effect, const EffectScore& first) {
  constexpr double same = 0.9, much = 0.5;  // likeness
  constexpr double undecided = 3;           // differences of ln p
  // What could imitate nearly all of it would explain the data nearly as well: likeness is an estimate, too.
  constexpr double comparable = 0.5;  // gain
  const bool explains = effect.best.gain >= comparable * first.best.gain;
  return (effect.likeness > same && explains) ||
         (effect.likeness > much && effect.ln_p - first.ln_p < undecided);
}

}  // namespace floe

#include "reco/diagnose/rivals.h"

#include <cmath>

namespace floe {

namespace {

constexpr double much = 0.5;  // likeness

}  // namespace

bool leads(const EffectScore& effect, const EffectScore& first) {
  constexpr double leading_share = 0.35, least_gain = 5;
  constexpr double by_chance = 0.05;  // for all its places
  return effect.best.gain >= leading_share * first.best.gain && effect.best.gain > least_gain &&
         effect.ln_p < std::log(by_chance);
}

// What is false gains but the square of its likeness to what is true.
bool is_alternative(const EffectScore& effect, const EffectScore& first) {
  constexpr double nearly = 0.75;
  return effect.likeness >= much || effect.best.gain >= nearly * first.best.gain;
}

bool is_inseparable(const EffectScore& effect, const EffectScore& first) {
  constexpr double same = 0.9;
  constexpr double undecided = 3;  // differences of ln p
  // What could imitate nearly all of it would explain the data nearly as well: likeness is an estimate, too.
  constexpr double comparable = 0.5;  // gain
  const bool explains = effect.best.gain >= comparable * first.best.gain;
  return (effect.likeness > same && explains) ||
         (effect.likeness > much && effect.ln_p - first.ln_p < undecided);
}

}  // namespace floe

// What a diagnosis adds to its base model and gives up again, and the record of it.
#pragma once

#include <cstddef>
#include <string>

#include "propagation/model.h"
#include "reco/diagnose/accepted_effects.h"
#include "reco/diagnose/diagnosis.h"
#include "reco/diagnose/effect_fits.h"

namespace floe {

class Additions {
 public:
  // Keeps references. What is given up, and why, becomes a remark of `record`.
  Additions(const Model& base, const EffectFits& fits, Diagnosis& record)
      : accepted_(base), fits_(fits), record_(record) {}

  const AcceptedEffects& accepted() const { return accepted_; }
  // Effects that came in, also those that were given up again.
  int count() const { return count_; }

  // The winner of the last look, with the fit of all that is there and of it. Earlier ones that it explains
  // away go.
  void add(NamedEffect winner, const IceFit& fit);
  // Of an effect's parameters by layers.
  void take_layers(std::size_t effect, const IceFit& fit) { accepted_.take_layers(effect, fit); }

  // "NAME was given up: `why`". The last look has not seen the model without it.
  void give_up(std::size_t effect, const std::string& why);
  void give_up_all(const std::string& why);
  // What a dropped effect had taken goes to the others; those without which there is no physical ice go, too.
  void refit();

 private:
  void give_up_faded();
  void drop(std::size_t effect);

  AcceptedEffects accepted_;
  const EffectFits& fits_;
  Diagnosis& record_;
  int count_ = 0;
};

}  // namespace floe

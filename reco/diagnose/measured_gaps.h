// How much of the gap closes in runs that were held out, and which of what was added they do not want.
#pragma once

#include "propagation/model.h"
#include "reco/diagnose/additions.h"
#include "reco/diagnose/diagnosis.h"
#include "reco/diagnose/effect_fits.h"
#include "reco/diagnose/stages.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

struct GapsToMeasure {
  const Model& base;
  const FlasherData& data;  // of the runs that `look` is of
  const FirstLook& look;
  const DiagnosisOptions& options;
  const EffectFits& fits;
  Stages& stages;
  bool gap_stays = false;  // the last look saw one
};

// Gives up effects that make light worse which the fit has not seen, by more than twice the noise of the
// simulations and by more than follows from what the others do not tell (of a string that only one flasher
// lights they tell nothing): the last one first, which may have come by what an earlier one has left. All of
// them where as many as may be added leave a gap together. Fills the gaps of the result, its folds and
// p_of_rest.
void measure_gaps(const GapsToMeasure& asked, Additions& additions, Diagnosis& result);

}  // namespace floe

// What blind trials hide: an effect of the catalogue, drawn at random in place, direction and strength.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/full_trials.h"
#include "reco/diagnose/score_test.h"

namespace floe {

struct Hidden {
  HiddenEffect effect;
  std::vector<IceParameter> parameters;
  std::vector<double> numbers;  // of the parameters
  Model model;                  // with it
};

// Expected significance in standard deviations for all places of the effect: what the diagnosis would say,
// and less than the place alone would be worth.
struct SignificanceRange {
  double least, most;
};

// At one of the places, all of one effect, as strong as wanted and as its parameters allow; nothing when many
// tries find no such.
std::optional<Hidden> draw_hidden(const std::vector<const TestedSuspect*>& places, const ScoreTester& tester,
                                  const Model& base, SignificanceRange wanted, std::mt19937_64& random);

}  // namespace floe

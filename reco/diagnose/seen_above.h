// The power of a diagnosis: how strong an effect must be to be seen.
#pragma once

#include <string>
#include <vector>

#include "reco/diagnose/score_test.h"

namespace floe {

// The least value of a parameter that would be named every other time.
struct SeenAbove {
  std::string effect, parameter, unit;
  double change = 0;  // from the base's own value; the median of all places
};

// Of all parameters of all suspects, each alone. `alpha`: probability of naming anything by chance; `floor`:
// relative change of light below which nothing is named (ScoreTester::test).
std::vector<SeenAbove> seen_above(const ScoreTester& tester, const Model& base, double alpha, double floor);

}  // namespace floe

// What the score test says of an effect beside the first in its ranking: worth a fit, an alternative, the
// same as far as these data know? docs/theory/diagnose.md has the reasons.
#pragma once

#include "reco/diagnose/score_test.h"

namespace floe {

// Whether it might be what is missing: it gains a good part of what the first does, and not by chance.
bool leads(const EffectScore& effect, const EffectScore& first);

// Whether it could stand in the place of the first, once the fit of that one has gained so much -ln L and may
// have left so much at most: if this were true, a false leader would gain the square of their likeness of
// what there is to gain, and leave the rest. One that is inseparable, or scores nearly as well, always could:
// a fit decides. One that scores far less is not what is missing instead, and may be missing beside it.
bool is_alternative(const EffectScore& effect, const EffectScore& first, double gained, double left);

// Whether the data cannot tell this effect from the first in the ranking: what they change is the same light
// and it gains half as much, or much of it and both may well be what is missing.
bool is_inseparable(const EffectScore& effect, const EffectScore& first);

// Whether the first in the ranking, if true, leaves it as much as leads: what it cannot imitate is for a look
// of its own.
bool waits(const EffectScore& effect, const EffectScore& first);

}  // namespace floe

// Effects on the modules of a string: which ones are meant.
#pragma once

#include <functional>
#include <string_view>

#include "propagation/effects/effect.h"

namespace floe {

EffectParameter string_parameter();

// Throws UsageError, in the name of `effect`, unless the detector has the string (number in any value) or,
// where `dom` is not 0, that module of it.
void expect_modules(const Detector& detector, double string, double dom, std::string_view effect);

// The detector with those modules changed: of a string or, where `dom` is not 0, one module of it. Names
// and drill holes stay.
Detector with_modules(const Detector& detector, double string, double dom,
                      const std::function<void(Module&)>& change);

}  // namespace floe

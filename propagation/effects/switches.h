// Names of the effects that can be switched off (switchable_effects() in propagation/model.h).
#pragma once

#include <string_view>

namespace floe {

// Throws UsageError unless `effect` is one of switchable_effects(); the message lists the known ones, the
// most similar first.
void expect_known_effect(std::string_view effect);

}  // namespace floe

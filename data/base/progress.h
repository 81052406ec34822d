// How long work tells its caller how far it is. The command line shows a bar; tests pass nothing.
#pragma once

#include <functional>
#include <string>

namespace floe {

// Called now and then, from one thread at a time: fraction done in [0, 1] and what is going on.
using Progress = std::function<void(double fraction, const std::string& stage)>;

}  // namespace floe

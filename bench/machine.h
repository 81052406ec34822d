// What the figures were measured on.
#pragma once

#include <string>

namespace floe {

// "AMD EPYC, 2 cores, g++ 12.2.0".
std::string machine_description();

}  // namespace floe

// When names of a diagnosis are not all that is missing.
#pragma once

#include <string>
#include <vector>

namespace floe {

struct Diagnosis;

// Why "unexplained" stands beside the names of a diagnosis, half a sentence each; empty where they explain
// its gap, which must have been measured. `something_remains`: what they leave is significant.
std::vector<std::string> why_unexplained(const Diagnosis& diagnosis, bool something_remains);

}  // namespace floe

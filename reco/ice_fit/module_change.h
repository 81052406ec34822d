// Which modules see other light when a parameter moves: the clock or the place of a string is nothing to the
// others.
#pragma once

#include <optional>
#include <vector>

#include "propagation/model.h"

namespace floe {

// By module of the detector.
struct ModuleChange {
  std::vector<char> touched;  // sees other light, or sees it at other times
  std::vector<char> moved;    // is somewhere else: a flasher there shines on all others in another way
  std::vector<double> later;  // its clock, by so much [ns]
  bool only_clocks = true;

  // None when more differs than modules one by one: ice, sources, how all modules accept light.
  static std::optional<ModuleChange> between(const Model& was, const Model& is);
};

}  // namespace floe

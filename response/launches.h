// When modules record: a crossing of the discriminator launches a module that is free, and neighbours on a
// string that launch at nearly the same time make the coincidence a hard one (arXiv:1612.05093, section 4.2;
// arXiv:0810.4930).
#pragma once

#include <span>
#include <vector>

#include "data/module_id.h"

namespace floe {

enum class CoincidenceMode {
  soft,  // isolated launches keep the charge stamp
  hard,  // isolated launches are not sent
  none   // every launch is kept whole
};

struct LaunchSettings {
  CoincidenceMode mode = CoincidenceMode::soft;
  double window = 1000;      // launches of neighbours are coincident within this [ns]
  int distance = 2;          // neighbours are at most so many modules away on the string
  double record = 6400;      // of a launch that is kept whole: 256 samples of 25 ns [ns]
  double rearm = 50;         // after it [ns]
  double soft_busy = 2450;   // of an isolated launch, from its beginning [ns]
  double chip_busy = 29000;  // an ATWD chip digitises for so long [ns]
  int chips = 2;
};

struct Launch {
  double time = 0;    // of the crossing [ns]
  bool hard = false;  // in coincidence with a neighbour
};

// Crossings of one module, in order of time [ns].
struct ModuleCrossings {
  ModuleId module;
  std::vector<double> times;
};

// The launches of each module, in order of time.
std::vector<std::vector<Launch>> launches_of(const LaunchSettings& settings,
                                             std::span<const ModuleCrossings> modules);

}  // namespace floe

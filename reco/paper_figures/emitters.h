// Flashers that stand in the middle of a ring of strings, and the modules that see them from all sides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/detector.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// A string has a ring when exactly six others stand `nearest` to `farthest` from it, none stands nearer, and
// no two of the six that follow one another are more than 90 degrees apart. Strings with a ring, in the order
// of their numbers, are divided into `count` groups of equal size; the middle one of each flashes. The depths
// are divided alike: of the k-th string the module flashes that is nearest to the middle of the k-th part.
struct EmitterRule {
  std::size_t count = 4;                 // fewer where fewer strings have a ring
  double top = 1650, bottom = 1800;      // depth of the flashers [m]
  double nearest = 100, farthest = 150;  // horizontal distance of the six [m]
  double depth_difference = 60;          // of modules that count, from the flasher, at most [m]
};

struct Neighbour {
  int string = 0;
  double distance = 0, azimuth = 0;    // horizontal, from the flasher [m], [0, 2 pi) [rad]
  std::vector<std::uint32_t> modules;  // indices of those that count
};

struct Emitter {
  ModuleId module;
  double depth = 0;                   // [m]
  std::vector<Neighbour> neighbours;  // six, by azimuth
};

// Throws NoResult when no string has both a ring and a module at these depths.
std::vector<Emitter> choose_emitters(const Detector& detector, const EmitterRule& rule = {});

// "63,20 at 1702 m"
std::string text_of(const Emitter& emitter);

// The same with each neighbour's modules at most so far above or below [m].
Emitter narrowed(const Emitter& emitter, double depth_difference, const Detector& detector);

// A flash of the emitter's six horizontal LEDs as a ring, symmetric about the vertical. `photons`: N, as
// floe simulate --flasher takes it.
RunRequest ring_flash(const Emitter& emitter, double photons, std::uint64_t seed, std::uint64_t stream,
                      int threads);

}  // namespace floe

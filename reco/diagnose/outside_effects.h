// What the catalogue of effects does not have: changes of light that a diagnosis can only call unexplained.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "data/flasher_run.h"
#include "geometry/detector.h"
#include "propagation/engine/simulator.h"

namespace floe {

struct OutsideEffect {
  std::string name;  // of none in the catalogue
  std::string text;  // with its size and place
  // Changes the hits of a run; what it draws, it draws from `random`.
  std::function<void(std::vector<SimulatedHit>& hits, const FlasherRun& run, std::mt19937_64& random)> apply;
};

// Kinds, one after another by `number`: LEDs that glow on; a curtain of dust, a vertical plane near the
// flashers that takes a share of the light that crosses it; modules that lose light where they see much of
// it; modules that lose late light. Sizes and places are drawn.
OutsideEffect draw_outside_effect(int number, const Detector& detector, const std::vector<FlasherRun>& runs,
                                  std::mt19937_64& random);

}  // namespace floe

// A detector of a few modules and hits in it, for the tests of what becomes of an event's hits.
#pragma once

#include <vector>

#include "data/event.h"
#include "geometry/detector.h"

namespace floe::test {

// Modules 1 to `count` of string 1, 17 m apart; those after the first `on` are switched off.
inline Detector one_string(int count, int on) {
  std::vector<Module> modules;
  for (int dom = 1; dom <= count; ++dom) {
    Module module;
    module.id = {1, dom};
    module.position = {0, 0, -17.0 * dom};
    module.on = dom <= on;
    modules.push_back(module);
  }
  return {"one string", modules};
}

inline Hit hit(int dom, double time, float charge = 1) {
  Hit h;
  h.module = {1, dom};
  h.time = time;
  h.charge = charge;
  return h;
}

}  // namespace floe::test

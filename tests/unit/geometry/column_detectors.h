// Detectors whose columns are not simply their strings.
#pragma once

#include <vector>

#include "geometry/detector.h"
#include "tests/unit/geometry/random_places.h"

namespace floe::test {

// Three strings of 60 modules, 17 m apart in height, that lean by an angle towards different sides.
inline Detector leaning_detector(double angle) {
  std::vector<Module> modules;
  for (int string = 1; string <= 3; ++string)
    for (int dom = 1; dom <= 60; ++dom) {
      const double down = 17.0 * (dom - 1), azimuth = 2.0 * string;
      Module module;
      module.id = {string, dom};
      module.position = Vec3(150.0 * string - 300, 40.0 * string, 500 - down);
      module.position += down * std::tan(angle) * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
      modules.push_back(module);
    }
  return Detector("leaning", modules);
}

// Modules at random within +-size in x and y, each at a height of its own.
inline Detector scattered_detector(Random& random, int count, double size) {
  std::vector<Module> modules;
  for (int dom = 1; dom <= count; ++dom) {
    Module module;
    module.id = {1, dom};
    module.position = Vec3(uniform(random, -size, size), uniform(random, -size, size), 0.7 * dom - 150);
    modules.push_back(module);
  }
  return Detector("scattered", modules);
}

}  // namespace floe::test

// A straight piece of a photon's way, as the finders of modules are asked about it.
#pragma once

#include "data/base/vec3.h"

namespace floe::test {

struct Segment {
  Vec3f origin, direction;
  float length;
};

}  // namespace floe::test

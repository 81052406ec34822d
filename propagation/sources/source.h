// Where light comes from. A new kind of source is one file that implements this interface.
#pragma once

#include <cstddef>
#include <optional>

#include "data/base/vec3.h"
#include "propagation/engine/random.h"

namespace floe {

struct EmittedPhoton {
  Vec3f position;    // [m]
  float time;        // [ns]
  Vec3f direction;   // unit vector
  float wavelength;  // [nm]
};

class Source {
 public:
  virtual ~Source() = default;

  // Expected number of photons, weighted with the acceptance (wavelength and area) of a nominal
  // module, before the detector's efficiencies: N of one repetition.
  virtual double photons() const = 0;

  // Draws one photon. Safe to call from many threads.
  virtual EmittedPhoton emit(RandomStream& random) const = 0;

  // The module whose own light this is; it does not see it.
  virtual std::optional<std::size_t> emitting_module() const { return std::nullopt; }
};

}  // namespace floe

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

// The same for many photons, structure of arrays.
struct alignas(64) EmittedPhotons {
  static constexpr int count = RandomStreams::count;
  float x[count], y[count], z[count], time[count];
  float nx[count], ny[count], nz[count], wavelength[count];
};

class Source {
 public:
  virtual ~Source() = default;

  // Expected number of photons, weighted with the acceptance (wavelength and area) of a nominal
  // module, before the detector's efficiencies: N of one repetition.
  virtual double photons() const = 0;

  // Draws EmittedPhotons::count photons, each from its own stream, in loops that become vector code. Safe to
  // call from many threads.
  virtual void emit(RandomStreams& random, EmittedPhotons& photons) const = 0;

  // Draws one photon, the same as it would be among many. (A source that has its own emit() of many needs
  // `using Source::emit;` to be asked for one.)
  EmittedPhoton emit(RandomStream& random) const;

  // The module whose own light this is; it does not see it.
  virtual std::optional<std::size_t> emitting_module() const { return std::nullopt; }
};

// For sources that are written one photon at a time, which is easier and slower.
class OneByOneSource : public Source {
 public:
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const final;

 protected:
  virtual EmittedPhoton emit_one(RandomStream& random) const = 0;
};

}  // namespace floe

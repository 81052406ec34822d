#include "propagation/sources/source.h"

namespace floe {

EmittedPhoton Source::emit(RandomStream& random) const {
  RandomStreams streams;
  for (int i = 0; i < RandomStreams::count; ++i) streams.set(i, random);
  EmittedPhotons photons;
  emit(streams, photons);
  random = streams[0];
  return {{photons.x[0], photons.y[0], photons.z[0]},
          photons.time[0],
          {photons.nx[0], photons.ny[0], photons.nz[0]},
          photons.wavelength[0]};
}

}  // namespace floe

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

void OneByOneSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  for (int i = 0; i < EmittedPhotons::count; ++i) {
    RandomStream stream = random[i];
    const EmittedPhoton photon = emit_one(stream);
    random.set(i, stream);
    photons.x[i] = photon.position.x();
    photons.y[i] = photon.position.y();
    photons.z[i] = photon.position.z();
    photons.time[i] = photon.time;
    photons.nx[i] = photon.direction.x();
    photons.ny[i] = photon.direction.y();
    photons.nz[i] = photon.direction.z();
    photons.wavelength[i] = photon.wavelength;
  }
}

}  // namespace floe

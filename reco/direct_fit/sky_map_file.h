// Maps of directions in HDF5; docs/formats.md explains every field.
#pragma once

#include <span>
#include <string>

#include "data/base/atomic_file.h"
#include "reco/direct_fit/sky_map.h"

namespace floe {

struct SkyMapOfEvent {
  std::string event;  // its name
  SkyMap map;
};

// Where the maps come from.
struct SkyMapProvenance {
  std::string version;  // release of floe
  std::string ice_name, ice_hash;
};

// Writes all maps and gives the file its name. Throws OutputError. HDF5 is not thread safe: one thread at a
// time may be here or in event files.
void write_sky_maps(AtomicFile& file, const SkyMapProvenance& provenance,
                    std::span<const SkyMapOfEvent> maps);

}  // namespace floe

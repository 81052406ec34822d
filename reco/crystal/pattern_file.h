// Diffusion patterns as HDF5; docs/formats.md says what every field is.
#pragma once

#include <span>
#include <string>

#include "data/base/atomic_file.h"
#include "reco/crystal/crystal_study.h"

namespace floe {

struct PatternProvenance {
  std::string version, command;  // release of floe; what was typed
  double wavelength;             // [nm]
};

// Writes all studies and gives the file its name. Throws OutputError. HDF5 is not thread safe: one thread at
// a time may be here or in event files.
void write_patterns(AtomicFile& file, const PatternProvenance& provenance,
                    std::span<const CrystalStudy> studies);

}  // namespace floe

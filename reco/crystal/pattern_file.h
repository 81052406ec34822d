// Diffusion patterns as HDF5; docs/formats.md says what every field is.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

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

// What such a file holds. Statistics are made anew from the photons, and are those that were written; fits
// are left to study_patterns. The grids' fabric stays isotropic: the file knows it by its name.
struct PatternFile {
  std::string name;  // of the file
  PatternProvenance provenance;
  std::vector<CrystalStudy> studies;
};
// Throws InputError: no such file, no patterns, another version of the format, values that no walk gives.
PatternFile read_patterns(const std::filesystem::path& path);

}  // namespace floe

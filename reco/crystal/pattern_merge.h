// Shares of diffusion patterns, made apart, as the patterns of one run.
#pragma once

#include <vector>

#include "reco/crystal/pattern_file.h"

namespace floe {

// All photons in the order of their numbers, and what follows from them: exactly what one run with as many
// photons gives. Shares may come in any order. Throws InputError, which names the file, where shares differ
// in anything but which photons they hold, and where photons are missing or there twice.
std::vector<CrystalStudy> merged_patterns(std::vector<PatternFile> shares);

}  // namespace floe

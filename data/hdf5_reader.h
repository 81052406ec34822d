// Reads floe's own HDF5 event files (docs/formats.md).
#pragma once

#include <filesystem>

#include "data/event_files.h"

namespace floe {

// Whether a file begins as HDF5 files do, whatever its name. Throws InputError when it cannot be read.
bool is_hdf5(const std::filesystem::path& path);

// Throws InputError: not HDF5, truncated or damaged, another format or version, a column missing or
// unknown, rows that do not fit together, values that no event may hold (data/event_rules.h).
EventFile read_hdf5_events(const std::filesystem::path& path);

}  // namespace floe

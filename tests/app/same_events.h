// Event files that hold the same.
#pragma once

#include <filesystem>

namespace floe::test {

// Settings, events, hits and waveforms. Bytes would not do: HDF5 writes the time into the root group.
void expect_same_events(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace floe::test

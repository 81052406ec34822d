// Digitised waveforms that stand beside the hits of an event file (docs/formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/module_id.h"

namespace floe {

// One trace as it was sent to the surface.
struct Waveform {
  ModuleId module;
  std::string digitiser;           // "atwd0", "atwd1", "atwd2" or "fadc"
  double time = 0, sample = 0;     // of sample 0, and from sample to sample [ns]
  double millivolt_per_count = 1;  // at the anode
  double baseline = 0;             // counts without light
  std::vector<int> counts;
};

// The waveforms of an event (its row of the table `events`), of its first repetition; none when the file
// holds no table `waveforms` or is no HDF5. Throws InputError when the tables are not as docs/formats.md
// says.
std::vector<Waveform> read_waveforms(const std::filesystem::path& file, std::uint64_t event);

}  // namespace floe

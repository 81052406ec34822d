// Flasher runs as commands that fit ice take them.
#pragma once

#include <string>
#include <vector>

#include "data/event.h"

namespace floe {

inline constexpr const char* flasher_data_description =
    "Flasher runs: .h5, or text with FLASHER lines (.hits, .txt, .dat, also .gz)";

// Throws InputError.
std::vector<Event> read_flasher_events(const std::string& file);

}  // namespace floe

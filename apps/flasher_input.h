// What commands that compare ice with flasher data read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/common_options.h"
#include "data/event.h"

namespace floe {

inline constexpr const char* flasher_data_description =
    "Flasher runs: .h5, or text with FLASHER lines (.hits, .txt, .dat, also .gz)";

// Events of an .h5 file, or flasher runs of a text with FLASHER lines. Throws InputError.
std::vector<Event> read_flasher_file(const std::string& file);

// Of simulations that are compared with these runs: what --oversize says, else that of the runs where they
// were simulated themselves, else the option's default. Throws InputError where that differs from run to run.
double oversize_for(const std::vector<Event>& runs, const SimulationSettings& settings);

// Two depths [m], "TOP,BOTTOM", of the option --depths. Throws UsageError.
std::pair<double, double> parse_depths(const std::string& text);

}  // namespace floe

// Event files as the command line names them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "data/event.h"

namespace floe {

// The name as it is when it ends in .h5, as floe's own event files must; UsageError otherwise.
const std::string& require_event_file_name(const std::string& file);

// EVENT...: one or more files, .h5, .hits or .dat, each text also gzipped.
void add_event_arguments(CLI::App& app, std::vector<std::string>& files);

// The events of all files, in order, as data; of several files, an event's name begins with its file's.
// Warns on stderr of weighted simulations: their hits are no counts.
std::vector<Event> read_events(const std::vector<std::string>& files);

}  // namespace floe

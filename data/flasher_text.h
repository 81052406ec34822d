// Sets of flasher runs as text (docs/formats.md): a line "FLASHER string DOM key=value ..." opens each run,
// its hits follow.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "data/event.h"

namespace floe {

// Hands over each run as an event named after its module ("63,20", "63,20-2", ...), in the order of the file,
// which holds only one run's hits at a time beside the text. Lines of photons ("HIT ...") are read from .hits
// and .txt, averaged charges ("string DOM time charge") from .dat, each also gzipped. A run may have no hits.
//
// Photons are those of all flashes together: with repeats=N each has charge 1/N, so that the event is an
// average. Charges are averages already.
//
// Throws InputError: malformed, an unknown or repeated key, a value that no run may have
// (data/event_rules.h), hits before the first run, no run at all.
void for_each_flasher_run(const std::filesystem::path& path, const std::function<void(const Event&)>& use);

// The line, with its end, that opens the run of an event which has one; what is unknown is left out. Numbers
// have 12 digits.
std::string flasher_line(const Event& event);

}  // namespace floe

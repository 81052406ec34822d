// f2k event text, as far as light sources need it (read_f2k itself is in data/event_files.h).
#pragma once

#include <string_view>

#include "data/base/text.h"
#include "data/event.h"

namespace floe {

// Whether a line that begins with `word` belongs to f2k and may stand among hits: V, TBEGIN, EM, TR ...
bool is_f2k_keyword(std::string_view word);

// The particle of "TR gen igen NAME x y z zenith azimuth length energy time" [m, deg, GeV, ns]; the
// azimuth is brought into 0..360 deg. Throws InputError.
Particle parse_track(const TextLine& line);

}  // namespace floe

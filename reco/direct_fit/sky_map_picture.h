// A picture of a map of directions, with contours.
#pragma once

#include <optional>
#include <string>

#include "reco/direct_fit/sky_map.h"

namespace floe {

// SVG text: -ln L in shades, contours of 50%, 90% and 99%, the best direction and, when it is known, the
// true one. Zenith rises downwards, azimuth to the right. Write it with write_whole_file.
std::string figure_of_sky_map(const SkyMap& map, const std::string& title,
                              const std::optional<Origin>& truth = {});

}  // namespace floe

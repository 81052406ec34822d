// How the sources of light of a run differ from what is said of them.
#pragma once

namespace floe {

// Flashers are known by their nominal settings; the true brightness, beam and clock of a board are not.
// At the values here they are as they are said to be. Cascades have no settings.
struct SourceSettings {
  double width_factor = 1;       // multiplies the width of a flasher's beams, >= 0
  double time_offset = 0;        // added to the time at which a flasher flashes [ns]
  double brightness_factor = 1;  // multiplies a flasher's photons, >= 0

  bool operator==(const SourceSettings&) const = default;
};

}  // namespace floe

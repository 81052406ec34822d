#include "apps/brightness_limit.h"

#include <fmt/format.h>

#include "data/base/error.h"

namespace floe {

void limit_brightness(double most, std::vector<PlannedEvent>& events) {
  for (PlannedEvent& event : events) {
    const double photons = event.photons();
    if (photons <= most) continue;
    event.share = most / photons;
    if (!(event.share >= 1e-30))
      throw UsageError(
          fmt::format("event {}: light of {:.3g} photons is more than can be simulated; at most "
                      "1e30 times what --most-photons allows, {:.3g}",
                      event.id, photons, most));
    event.repeats *= event.share;
    fmt::print(stderr,
               "floe: warning: event {}: of {:.3g} photons to propagate {:.3g} are simulated, and each hit "
               "counts {:.4g} times (its repeats in the file are {:.6g}); --most-photons N sets how many\n",
               event.id, photons, most, 1 / event.share, event.repeats);
  }
}

}  // namespace floe

#include "response/discriminator.h"

#include <algorithm>

namespace floe {

namespace {

constexpr double step = 1;  // at which the voltage is looked at [ns]: a pulse rises in some nanoseconds

}  // namespace

std::vector<double> threshold_crossings(const DiscriminatorSettings& settings, const PulseShape& shape,
                                        std::span<const Photoelectron> photoelectrons) {
  const double threshold = settings.threshold * shape.peak();
  std::vector<double> crossings;
  double before = 0, time = 0, done = -1e300;  // voltage one step ago; looked at until
  for (const Photoelectron& pe : photoelectrons) {
    const double end = pe.time + shape.end();
    if (pe.time + shape.begin() > done) {  // the pulses before have ended
      before = 0;
      time = pe.time + shape.begin();
    }
    done = std::max(done, end);
    // Until the peak of this pulse, and on: later photoelectrons go on from there.
    const double until = pe.time + shape.peak_time() + step;
    for (; time < until; time += step) {
      const double now = sum_of_pulses(shape, photoelectrons, time);
      if (before < threshold && now >= threshold)
        crossings.push_back(time - step * (now - threshold) / (now - before));
      before = now;
    }
  }
  return crossings;
}

}  // namespace floe

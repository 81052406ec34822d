#include "reco/ice_fit/noise_slopes.h"

#include <algorithm>

namespace floe {

Eigen::VectorXd noise_of_bins(const RunBins& bins, const NoiseWindow& window) {
  Eigen::VectorXd noise(bins.size());
  for (const RunBins::Receiver& receiver : bins.receivers()) {
    double begin = window.from;
    for (int i = 0; i < receiver.bins(); ++i) {
      // The last bin is open.
      const bool last = i + 1 == receiver.bins();
      const double end =
          last ? window.to
               : std::clamp(receiver.inner_edges[static_cast<std::size_t>(i)], window.from, window.to);
      noise(receiver.first + i) = std::max(0.0, end - begin) * seconds_per_nanosecond * window.readouts;
      begin = std::max(begin, end);
    }
  }
  return noise;
}

}  // namespace floe

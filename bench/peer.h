// Another program on the same work, turn by turn with this one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/statistics.h"
#include "bench/workloads.h"

namespace floe {

struct PeerRequest {
  // For the shell. Replaced in it: {workload} by its name, {ice} as given, {photons} by how many to
  // propagate, {brightness} by the source that gives as many: N of the flasher, GeV of the cascade.
  std::string command;
  double photons = 0;  // that the command propagates
  // How the command's output says how many it did propagate: an ECMAScript regular expression whose first
  // group is a number; the numbers of all lines that match are added up. None: `photons`.
  std::optional<std::string> count;
  int rounds = 5;
};

// How many times as many photons a second floe propagates, by the processor's time and by the clock.
struct PeerComparison {
  double brightness;     // of the source, for both
  double peer_photons;   // a round
  double startup;        // of the peer, subtracted [s of the processor]
  Spread floe, peer;     // photons/s of the processor's time
  Spread ratio;          // of neighbouring turns
  Spread ratio_by_wall;  // the same by the clock
};

// In each round this program propagates `photons`, the peer its share, and the peer once more the smallest
// work that can be asked for, which is what starting it costs. Throws Error when the peer fails, UsageError
// when the count cannot be found.
PeerComparison compare_with_peer(const Simulator& simulator, const std::string& ice, const Workload& workload,
                                 double photons, std::uint64_t seed, int threads, const PeerRequest& request);

}  // namespace floe

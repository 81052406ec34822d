// What a second thread is worth: two threads in one process against two processes of one thread each.
#pragma once

#include <cstdint>
#include <functional>

#include "bench/statistics.h"
#include "bench/workloads.h"

namespace floe {

struct ScalingComparison {
  Spread two_threads, two_processes;  // photons/s by the clock
  Spread ratio;                       // of neighbouring turns
};

// Each thread and each process propagates `photons` a round; the two processes begin together, when both
// have made their simulator.
ScalingComparison compare_scaling(const std::function<Simulator()>& make_simulator, const Workload& workload,
                                  double photons, std::uint64_t seed, int rounds);

}  // namespace floe

#include "bench/scaling.h"

#include <numeric>

#include "bench/child_process.h"

namespace floe {

namespace {

// Photons a second of all processes together, each with so many threads.
double speed_of(const std::function<Simulator()>& make_simulator, const Workload& workload, double photons,
                std::uint64_t seed, int processes, int threads) {
  const auto piece = [&](int i) -> ChildWork {
    return [&, i](const std::function<void()>& ready) {
      const Simulator simulator = make_simulator();
      const auto source = make_source(workload, simulator.model(), reference_brightness(workload));
      ready();
      const auto run =
          run_photons(simulator, *source, photons * threads, seed + static_cast<std::uint64_t>(i), threads);
      return Json(static_cast<double>(run.summary.propagated) / run.summary.seconds);
    };
  };
  std::vector<ChildWork> work;
  for (int i = 0; i < processes; ++i) work.push_back(piece(i));
  const auto results = run_in_children(work);
  return std::accumulate(results.begin(), results.end(), 0.0, [](double sum, const ChildResult& child) {
    return sum + child.result.get<double>();
  });
}

}  // namespace

ScalingComparison compare_scaling(const std::function<Simulator()>& make_simulator, const Workload& workload,
                                  double photons, std::uint64_t seed, int rounds) {
  std::vector<double> threads, processes, ratio;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t round_seed = seed + 2 * static_cast<std::uint64_t>(round);
    threads.push_back(speed_of(make_simulator, workload, photons, round_seed, 1, 2));
    processes.push_back(speed_of(make_simulator, workload, photons, round_seed, 2, 1));
    ratio.push_back(threads.back() / processes.back());
  }
  return {spread_of(threads), spread_of(processes), spread_of(ratio)};
}

}  // namespace floe

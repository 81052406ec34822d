// crystal_crossings: boundaries between grains that one core crosses in a second, in the plain and in the
// fast version of the walk.
#include <benchmark/benchmark.h>

#include "propagation/crystal/walk.h"

namespace floe {
namespace {

constexpr int crossings = 1000;
constexpr std::size_t photons = 640;

Polycrystal girdle_ice() {
  return {crystal_indices(405), Fabric::girdle(), spheroid(1.4)};
}
Polycrystal measured_ice() {
  return {crystal_indices(405), Fabric::from_eigenvalues(fabric_eigenvalues(0.1, 4)), spheroid(1.4)};
}

CrystalWalk walk_at(std::int64_t angle) {
  return {static_cast<double>(angle) * degree, crossings, 1e-3};
}

void plain(benchmark::State& state, const Polycrystal& ice) {
  std::uint64_t photon = 0;
  for (auto _ : state) benchmark::DoNotOptimize(walk_plainly(ice, walk_at(state.range(0)), {1, 0, photon++}));
  state.SetItemsProcessed(state.iterations() * crossings);
}

void fast(benchmark::State& state, const Polycrystal& ice) {
  std::uint64_t photon = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(walk_photons(ice, walk_at(state.range(0)), {1, 0, photon}, photons, 1));
    photon += photons;
  }
  state.SetItemsProcessed(state.iterations() * crossings * static_cast<std::int64_t>(photons));
}

// By the angle to the flow [deg]; items are crossings.
BENCHMARK_CAPTURE(plain, girdle, girdle_ice())->Arg(30)->UseRealTime();
BENCHMARK_CAPTURE(plain, measured_fabric, measured_ice())->Arg(30)->UseRealTime();
BENCHMARK_CAPTURE(fast, girdle, girdle_ice())->Arg(0)->Arg(30)->Arg(60)->Arg(90)->UseRealTime();
BENCHMARK_CAPTURE(fast, measured_fabric, measured_ice())->Arg(0)->Arg(30)->Arg(60)->Arg(90)->UseRealTime();

}  // namespace
}  // namespace floe

BENCHMARK_MAIN();

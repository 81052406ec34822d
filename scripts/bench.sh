#!/usr/bin/env bash
# Installs what is missing, builds the benchmarks, and runs them: the inner parts of the engine, the walk through
# crystals, then whole workloads. Options are passed on to floe-bench, e.g.
#   scripts/bench.sh --ice my-ice --scaling
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

floe_packages+=(libbenchmark-dev)
floe_install_packages
echo "== Building the benchmarks (some minutes the first time)" >&2
(cd "$floe_root" && floe_quietly cmake --preset release -DFLOE_BUILD_BENCHMARKS=ON)
floe_compile inner_parts crystal_crossings floe-bench

"$floe_build/bench/inner_parts" --benchmark_min_time=0.05 --benchmark_repetitions=5
"$floe_build/bench/crystal_crossings" --benchmark_min_time=0.5 --benchmark_repetitions=5
"$floe_build/bench/floe-bench" "$@"

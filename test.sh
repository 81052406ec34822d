#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. Options are passed on to ctest, e.g.
#   ./test.sh -L unit        one label: unit, physics, regression or app
#   ./test.sh -R detector    tests whose name matches
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

started=$SECONDS
floe_install_packages
echo "== Building floe and its tests (some minutes the first time)"
floe_compile all
built=$SECONDS

# Two programs at a time: the simulation uses all cores by itself, but much beside it uses one. Threads that wait
# for others leave the cores to the other program.
reports="$floe_build/test-reports"
rm -rf "$reports"
mkdir -p "$reports"
echo "== Running the tests"
status=0
OMP_WAIT_POLICY=passive GTEST_OUTPUT="xml:$reports/" ctest --test-dir "$floe_build" --parallel 2 \
  --output-on-failure --no-tests=error --output-junit "$reports/ctest.junit" "$@" || status=$?

echo
echo "Build $((built - started)) s, tests $((SECONDS - built)) s."
bash "$floe_root/scripts/summarise_tests.sh" "$reports" || status=1
exit "$status"

#!/usr/bin/env bash
# Rooms depend one way: data <- geometry <- propagation <- response <- reco <- apps. Fails, naming file and line,
# when a file includes from a room after its own.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

rooms=(data geometry propagation response reco apps)
status=0
for ((i = 0; i < ${#rooms[@]}; ++i)); do
  for ((j = i + 1; j < ${#rooms[@]}; ++j)); do
    if grep -rnE --include='*.h' --include='*.cpp' "^[[:space:]]*#[[:space:]]*include[[:space:]]*[\"<](\.\./)*${rooms[j]}/" \
      "${rooms[i]}"; then
      echo "^ ${rooms[i]}/ must not include from ${rooms[j]}/" >&2
      status=1
    fi
  done
done
# Includes name files by their path from the root, so that the rule above sees them all.
if grep -rnE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"([^/"]*|\.\./[^"]*)"' \
  "${rooms[@]}" tests bench; then
  echo "^ includes name files by their path from the project's root, as in \"geometry/detector.h\"" >&2
  status=1
fi
exit "$status"

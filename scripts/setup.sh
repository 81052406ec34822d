# Set-up shared by demo.sh and test.sh: Debian packages, configuration, build. To be sourced.
# shellcheck shell=bash

floe_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
floe_build="$floe_root/build/release"

# Everything that building and testing needs; cmake/FloeDependencies.cmake says what each is for.
floe_packages=(
  cmake ninja-build g++ pkg-config
  libembree-dev libeigen3-dev libceres-dev libhdf5-dev zlib1g-dev
  libcli11-dev nlohmann-json3-dev libtoml11-dev libfmt-dev librandom123-dev libxxhash-dev
  libgtest-dev
)

# Runs a command quietly; shows what it said only when it fails.
floe_quietly() {
  local log
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    echo "floe set-up: this command failed: $*" >&2
    return 1
  fi
  rm -f "$log"
}

floe_missing_packages() {
  local package
  for package in "${floe_packages[@]}"; do
    dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      echo "$package"
  done
}

floe_install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "floe set-up: not a Debian system; assuming that these are installed under their own names:" >&2
    echo "  ${floe_packages[*]}" >&2
    return
  fi
  local missing
  mapfile -t missing < <(floe_missing_packages)
  if [ ${#missing[@]} -eq 0 ]; then return; fi

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! sudo -n true 2>/dev/null; then
      echo "floe set-up: these Debian packages are missing: ${missing[*]}" >&2
      echo "Install them with" >&2
      echo "  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
      echo "and start again." >&2
      return 1
    fi
    as_root=(sudo -n)
  fi
  echo "== Installing ${#missing[@]} Debian packages: ${missing[*]}"
  floe_quietly "${as_root[@]}" apt-get update
  floe_quietly "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "${missing[@]}"
}

# As many compilers as there are cores, but no more than memory for 2 GB each.
floe_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 2e6) }' /proc/meminfo)
  if [ "$memory" -lt "$cores" ]; then cores=$memory; fi
  echo $((cores > 1 ? cores : 1))
}

# floe_compile TARGET...: configures the preset `release` and builds the targets.
floe_compile() {
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  (
    cd "$floe_root"
    floe_quietly cmake --preset release "${launcher[@]}"
    floe_quietly cmake --build --preset release --parallel "$(floe_jobs)" --target "$@"
  )
}

#!/usr/bin/env bash
# Installs what is missing, builds floe, and does its main job once on built-in ice and detector:
# simulate a cascade in birefringent ice, fit it with and without birefringence, compare.
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

floe_install_packages
echo "== Building floe (a few minutes the first time)"
floe_compile floe

cd "$floe_root"
floe=build/release/apps/floe
mkdir -p demo-output

show() {
  echo
  echo "\$ $*"
  "$@"
}

echo "== A cascade in the idealised South Pole ice, and two fits to it"
show "$floe" simulate --ice south-pole --cascade 20,-40,-300,70,130,3000 -o demo-output/event.h5
show "$floe" compare demo-output/event.h5 --ice south-pole --without birefringence \
  --json demo-output/compare.json --picture demo-output/compare.svg

cat <<END

The picture is demo-output/compare.svg: open it in a browser.

What to try next:
  $floe info                        the ice and the detector that were used
  $floe info --ice DIRECTORY        your own ice model
  $floe reconstruct EVENT.hits      a fit to your own hits
  $floe --help                      all commands; each has --help with examples
  docs/guide/getting-started.md           the same, step by step
END

#!/usr/bin/env bash
# update_readme.sh [FILE...]: runs the commands in the console blocks of README.md and of the guide again
# and puts what they print in place of what stood there, so that every number is from a command beside
# it. Commands run in demo-output/, with the built floe as `floe`; lines of a block that begin with "$ "
# are commands, all others are output.
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

floe_compile floe
export PATH="$floe_build/apps:$PATH"
mkdir -p "$floe_root/demo-output" "$floe_root/docs/pictures"

renewed() { # FILE
  local line inside=no
  while IFS= read -r line; do
    case "$inside,$line" in
      no,'```console') inside=yes ;;
      yes,'```') inside=no ;;
    esac
    if [ "$inside" = no ] || [ "$line" = '```console' ]; then
      printf '%s\n' "$line"
    elif [[ $line == '$ '* ]]; then
      printf '%s\n' "$line"
      # Exit codes are part of what is shown (head closes its pipe early, too); progress, which only commands
      # that take long print, is not.
      (cd "$floe_root/demo-output" && bash -c "${line#\$ }" 2>&1 </dev/null) | grep -vE '^ *[0-9]+%  .* left  ' || true
    fi
  done <"$1"
}

cd "$floe_root"
if [ $# -eq 0 ]; then
  set -- README.md docs/guide/{getting-started,simulate,reconstruct,respond,view}.md
fi
for file in "$@"; do
  echo "== $file"
  renewed "$file" >"$file.new"
  mv "$file.new" "$file"
done
if [ -f demo-output/compare.svg ]; then cp demo-output/compare.svg docs/pictures/; fi

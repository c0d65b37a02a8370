#!/bin/bash
# Shows what Vantage does: installs what is missing, builds, makes a labyrinth of rooms and renders
# the plates that compare the methods on it. Run again, it redoes only what is out of date.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=.ci/packages.sh
source .ci/packages.sh
# shellcheck source=.ci/build.sh
source .ci/build.sh

build=out/build
vantage=$build/apps/vantage/vantage
scene=out/labyrinth.vtp
sheet=out/contact-sheet.png

# is_current FILE SOURCE...: FILE exists and no source is newer.
is_current()
{
  local file=$1 source
  shift
  [[ -s $file ]] || return 1
  for source in "$@"; do
    [[ ! $source -nt $file ]] || return 1
  done
}

install_packages
build_project release "$build" vantage

if ! is_current "$scene" "$vantage" apps/demo.sh; then
  "$vantage" labyrinth -o "$scene"
fi
if ! is_current "$sheet" "$vantage" "$scene" apps/demo.sh; then
  "$vantage" plates "$scene" -o out
fi
if [[ ! -s $sheet ]]; then
  echo "error: 'vantage plates' wrote no $sheet" >&2
  exit 1
fi
echo "The contact sheet is $sheet"

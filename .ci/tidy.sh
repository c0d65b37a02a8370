#!/bin/bash
# Runs clang-tidy, with the checks of .clang-tidy.
#
#   .ci/tidy.sh              on the sources changed or added since the last commit
#   .ci/tidy.sh --all        on every source that is built
#   .ci/tidy.sh FILE...      on these
#
# Sources are .cpp and .cxx files; headers are checked with the sources that include them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=.ci/packages.sh
source .ci/packages.sh

build=out/build
vantage_packages+=(clang-tidy-14)
install_packages
if [[ ! -f $build/compile_commands.json ]]; then
  cmake -C .cmake/release.cmake -S . -B "$build" >/dev/null
fi

case "${1:-}" in
  --all)
    mapfile -t files < <(git ls-files --cached --others --exclude-standard '*.cpp' '*.cxx')
    ;;
  "")
    mapfile -t files < <(git diff --name-only --diff-filter=d HEAD -- '*.cpp' '*.cxx'
      git ls-files --others --exclude-standard '*.cpp' '*.cxx')
    ;;
  *)
    files=("$@")
    ;;
esac
if ((${#files[@]} == 0)); then
  echo "No changed sources."
  exit 0
fi
printf '%s\0' "${files[@]}" |
  xargs --null --max-args=1 --max-procs="$(nproc)" clang-tidy-14 --quiet -p "$build"

#!/bin/bash
# Installs what is missing, builds, and runs the whole suite on Debian 12.
#
#   tests/run.sh [--sanitize | --thread] [CTEST ARGUMENT...]
#
#   --sanitize   address and undefined-behaviour sanitizers, unit and property tests
#   --thread     thread sanitizer, the same tests
#   further arguments go to ctest, for example -R visibility or -L unit
#
# Builds below out/. The last lines are ctest's own; exits 0 only if tests ran and all passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=.ci/packages.sh
source .ci/packages.sh
# shellcheck source=.ci/build.sh
source .ci/build.sh

settings=release
build=out/build
selection=()
cpus=()
case "${1:-}" in
  --sanitize)
    settings=sanitize
    ;;
  --thread)
    settings=thread
    # Given one core, Embree builds its hierarchies on the calling thread instead of on oneTBB's,
    # where the sanitizer takes each allocation for a race. Our loops have several threads always.
    cpus=(taskset --cpu-list "$(taskset --cpu-list --pid $$ | sed 's/.*: \([0-9]*\).*/\1/')")
    ;;
  --help)
    sed -n '2,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
if [[ $settings != release ]]; then
  build=out/build-$settings
  selection=(--label-regex '^(unit|property)$')
  shift
  # Sanitized code is slow; see tests/properties/IdentitiesTest.cpp.
  export VANTAGE_SCENES=${VANTAGE_SCENES:-50}
fi
export ASAN_OPTIONS=detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1

install_packages
build_project "$settings" "$build"

# A virtual display for the tests that draw. ctest alone calls a suite a success in which tests were
# skipped or disabled, or all of them; so look at what it did.
results=$build/results.xml
rm -f "$results"
status=0
xvfb-run --auto-servernum --server-args='-screen 0 1280x1024x24' "${cpus[@]}" \
  ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error \
  --no-label-summary --output-junit "$PWD/$results" "${selection[@]}" "$@" || status=$?
if ((status == 0)) && { ! grep --quiet 'status="run"' "$results" ||
  grep --quiet -E 'status="(notrun|disabled)"' "$results"; }; then
  echo "error: not every test was executed" >&2
  status=1
fi
exit "$status"

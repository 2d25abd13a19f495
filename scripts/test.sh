#!/usr/bin/env bash
# Second command: installs missing packages, builds everything and runs all tests except those labelled `long`.
# Arguments go to ctest, e.g. scripts/test.sh -L unit
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing run test
build_targets
tests=(ctest --preset default --parallel "$(nproc)" "$@")
if [ -n "${CI:-}" ]; then
  # ctest's closing lines are the last word of a log that a machine reads.
  print_phase_times
  exec "${tests[@]}"
fi
phase "tests" "${tests[@]}"
print_phase_times
# ctest names skipped tests but writes their reasons only to its log. Print each reason once, with its number of tests.
awk '/^skipped: / { ++seen[substr($0, 10)] } /: Skipped$/ { getline; ++seen[$0] }
  END { for (why in seen) print "[gem] skipped: " why " (" seen[why] (seen[why] == 1 ? " test)" : " tests)") }' \
  build/Testing/Temporary/LastTest.log | sort
say "all selected tests passed; to run the long ones: ctest --test-dir build -L long"

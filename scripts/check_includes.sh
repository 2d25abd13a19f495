#!/usr/bin/env bash
# Checks rules that no compiler enforces: the one-way order of layers, where third-party libraries may be included, and which
# functions would make machines or locales disagree. Prints file:line: rule: text. Exit code 1: a rule is broken.
# Usage: scripts/check_includes.sh [TREE]      scripts/check_includes.sh --rules
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# Exceptions: path, rule, word, reason. An exception that is not needed is reported too.
allowances=$(
  cat <<'END'
gem/events/events.cpp bits exp once per run on the host; every engine is given the number
gem/geometry/polygon.cpp bits atan2 checks the outline that a user gave, before the first time step
gem/events/platform/mooring.h bits exp once per run on the host; every engine is given the coefficients
gem/events/platform/mooring.h bits cos once per run on the host; every engine is given the coefficients
gem/events/platform/mooring.h bits sin once per run on the host; every engine is given the coefficients
gem/events/crushing.h bits exp the duration of crushing is a reported quantity outside the step
gem/events/crushing.h bits lgamma the duration of crushing is a reported quantity outside the step
gem/engine/cuda/thread_groups.cuh order atomic counts of integers: any order gives the same
END
)

rules=(layer unknown-layer events-sees analysis-sees cuda toml hdf5 gsl eigen box2d httplib zlib cli11 oracle locale bits order allowance)
if [ "${1:-}" = --rules ]; then
  printf '%s\n' "${rules[@]}"
  exit 0
fi

cd "${1:-$scripts/..}"
# an example of the manual is checked where its copy stands: check_example_law.sh
mapfile -t files < <(find gem baseline_box2d validation bench -path gem/manual -prune -o -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' \) -print 2>/dev/null | sort)
[ "${#files[@]}" -gt 0 ] || { echo "no C++ files under $PWD" >&2 && exit 2; }

ALLOWANCES=$allowances awk -f "$scripts/check_includes.awk" "${files[@]}"

#!/bin/sh
# How fast does the ice of two runs part that differ by the place of one floe? Half an hour of run 1 with `coupled` and with
# `independent` contacts, five fields each, one floe moved by 1e-9 to 1e-3 m.
# Usage: scripts/ice_distances.sh [PROGRAM]    then: scripts/paper_report.sh
#   PROGRAM   build/ice_distances without one; writes ice_distances.csv in validation/paper
# Environment: GEM_SECONDS=1800 simulated; GEM_JOBS=2 fields at a time; GEM_OUT=validation/paper
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/ice_distances}
[ -x "$program" ] || {
  echo "no $program (not built) run: cmake --workflow --preset default" >&2
  exit 2
}
out=${GEM_OUT:-validation/paper}
mkdir -p "$out"
"$program" cases/004_400_25.toml "${GEM_SECONDS:-1800}" "${GEM_JOBS:-2}" "$out/ice_distances.csv"

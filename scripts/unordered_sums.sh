#!/bin/sh
# When do repeats of run 1 part whose sums are taken in single precision in no fixed order? Two hours of run 1 with
# `independent` and with `coupled` contacts: in order, repeated, and with one floe moved by 1e-9 m. Took 26 minutes on
# two cores busy with other work.
# Usage: scripts/unordered_sums.sh [PROGRAM]    then: scripts/paper_report.sh
#   PROGRAM   build/unordered_sums without one; writes unordered_runs.csv and unordered_distances.csv in validation/paper
# Environment: GEM_SECONDS=7200 simulated; GEM_JOBS=2 runs at a time; GEM_OUT=validation/paper
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/unordered_sums}
[ -x "$program" ] || {
  echo "no $program (not built) run: cmake --workflow --preset default" >&2
  exit 2
}
out=${GEM_OUT:-validation/paper}
mkdir -p "$out"
"$program" cases/004_400_25.toml "${GEM_SECONDS:-7200}" "${GEM_JOBS:-2}" "$out/unordered_runs.csv" \
  "$out/unordered_distances.csv"

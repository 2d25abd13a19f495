#!/usr/bin/env bash
# Data, figures and pages of speed against error: validation/baseline/speed_against_error.md and the ensembles' part of
# validation/baseline/README.md.
# Usage: scripts/speed_against_error.sh --measure JOBS [PART...]   measures here (scripts/measure.sh), then makes the pages
#        scripts/speed_against_error.sh RESULTS.tar.gz             the same from a measurement made elsewhere
#        scripts/speed_against_error.sh --with FILE.csv            adds another engine's rows of any of the tables
#        scripts/speed_against_error.sh                            makes the pages again
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export LC_ALL=C
kept=bench/results/speed_against_error
mkdir -p "$kept/other"

# keep FOLDER: its tables are those of the pages from now on
keep() {
  local table
  for table in conditions.txt closed_form_errors.csv windows.csv paths.csv speed.csv ensemble_rows.csv ensembles.csv map_means.csv; do
    [ ! -e "$1/$table" ] || cp "$1/$table" "$kept/"
  done
}

case ${1:-} in
--measure)
  jobs=${2:-$(nproc)}
  [ -x build/window_errors ] || {
    echo "no build/window_errors (not built) run: cmake --build build --target gem_measurements" >&2
    exit 2
  }
  scripts/measure.sh build runs/measurement "$jobs" "${@:3}"
  keep runs/measurement/results
  ;;
--with)
  cp "$2" "$kept/other/"
  ;;
*.tar.gz)
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  tar -C "$work" -xzf "$1" results
  keep "$work/results"
  ;;
"") ;;
*)
  sed -n '2,7s/^# //p' "$0" >&2
  exit 2
  ;;
esac
python3 scripts/speed_against_error.py
python3 scripts/ensembles_page.py

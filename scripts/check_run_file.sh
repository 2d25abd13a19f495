#!/usr/bin/env bash
# Runs a case and reads its run file with ncdump, h5py and xarray, as far as they are installed. Exit code 77: none is.
# Usage: check_run_file.sh GEM CASE.toml
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" run "$2" --quiet --until 20 --out "$folder/run.h5"
checked=0
if command -v ncdump >/dev/null; then
  header=$(ncdump -h "$folder/run.h5")
  for word in 'group: platform' 'time = UNLIMITED' 'ice_force_x:units = "N"' 'gem_status = "complete"'; do
    grep -qF "$word" <<<"$header" || { echo "ncdump: no '$word'"; exit 1; }
  done
  if grep -q phony <<<"$header"; then echo "ncdump: an axis without a name"; exit 1; fi
  echo "ncdump: reads the file"
  checked=1
else
  echo "ncdump: not installed (package netcdf-bin)"
fi
python=/usr/bin/python3
if "$python" -c 'import h5py' 2>/dev/null; then
  "$python" "$(dirname "${BASH_SOURCE[0]}")/check_run_file.py" "$folder/run.h5"
  checked=1
else
  echo "h5py: not installed (package python3-h5py)"
fi
[ "$checked" = 1 ] || exit 77

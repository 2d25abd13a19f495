#!/usr/bin/env bash
# Runs a sweep, collects it, and opens the summary with xarray. Exit code 77: xarray or h5netcdf is missing.
# Usage: check_summary.sh GEM SWEEP.toml
set -euo pipefail
python=/usr/bin/python3
if ! "$python" -c 'import xarray, h5netcdf' 2>/dev/null; then
  echo "skipped: no xarray with h5netcdf (packages python3-xarray python3-h5netcdf)"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" sweep run "$2" --quiet --threads 1 --out "$folder/runs"
"$1" sweep status "$folder/runs" --json >"$folder/status.json"
"$1" analyse --json "$folder/runs/middle_4000000.h5" >"$folder/analyse.json"
"$1" sweep collect "$folder/runs" --out "$folder/summary.nc.h5"
"$1" sweep collect "$folder/runs" --out "$folder/exact.nc.h5" --index 2-3 --series 0.5 --exact
"$1" sweep collect "$folder/runs" --out "$folder/lean.nc.h5" --series 0
"$python" "$(dirname "${BASH_SOURCE[0]}")/check_summary.py" "$folder"

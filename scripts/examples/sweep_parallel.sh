#!/usr/bin/env bash
# A sweep with GNU parallel: one run per job, two at a time, with a log of the times. Call it again to continue.
# Usage: sweep_parallel.sh SWEEP.toml DIR    (gem on the PATH, or GEM=path/to/gem)
set -euo pipefail
gem=${GEM:-gem}
runs=$("$gem" sweep list "$1" --json | grep -c '"index"')
mkdir -p "$2"
seq "$runs" | parallel --jobs 2 --joblog "$2/jobs.log" \
  "$gem" sweep run "$1" --out "$2" --index {} --threads 1 --quiet
"$gem" sweep status "$2"

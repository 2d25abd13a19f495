#!/bin/sh
# Runs the study of the coupled resolution's method and writes validation/solver_study.md: about 5 minutes of one core.
# The rows of the solver's versions (rounds_*.csv) need programs of older commits and are kept: the page says what made them.
# Usage: scripts/solver_study.sh [BUILD_FOLDER]
set -eu
cd "$(dirname "$0")/.."
build=${1:-build}
out=bench/results/solver_study
mkdir -p "$out"
cmake --build "$build" --target frozen_study moving_study
frozen() { "$build/frozen_study" "$2" "$3" "$4" >"$out/frozen_$1.csv"; }
moving() { "$build/moving_study" "$2" "$3" "$4" "$5" >"$out/moving_$1.csv"; }
jam=cases/table1.toml#400_200_100
squeeze=cases/hard/H16_squeeze.toml#H16_100
column=cases/hard/H01_columns.toml#H01_100
frozen jam jam "$jam" 100,300,600
frozen plug plug cases/004_400_25.toml 1000,2000
frozen column column "$column" 1,20
frozen squeeze squeeze "$squeeze" 40,60
moving jam "jam 200 s" "$jam" 200 6
moving late "jam 500 s" "$jam" 500 3
moving squeeze squeeze "$squeeze" 0 100
moving column column "$column" 0 20
scripts/solver_study.py

#!/usr/bin/env bash
# Runs the closed-form cases on gem's engines and on Box2D and rewrites validation/baseline: closed_form.csv and the
# generated part of README.md. Nothing is judged here; a number that Box2D misses is shown, not failed.
# Usage: scripts/baseline_table.sh [build folder]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export LC_ALL=C

build=${1:-build}
for program in gem_verification_tests gem_sustained_survey; do
  if [ ! -x "$build/$program" ]; then
    echo "no $build/$program (not built) run: cmake --build $build --target $program" >&2
    exit 2
  fi
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

GEM_TABLE=$work/gem.csv "$build/gem_verification_tests" --gtest_filter='*cpu*' --gtest_brief=1 >"$work/log"
# tests fail here where Box2D misses gem's tolerances: their rows are what is wanted
GEM_BASELINES=1 GEM_TABLE=$work/box2d.csv "$build/gem_verification_tests" --gtest_filter='*box2d*' >"$work/log" 2>&1 || true
GEM_BASELINES=1 "$build/gem_sustained_survey" >"$work/sustained.csv"
python3 scripts/baseline_table.py "$work/gem.csv" "$work/box2d.csv" "$work/sustained.csv"

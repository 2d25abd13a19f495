#!/usr/bin/env bash
# Judges the paper's statements by a folder of run files: writes OUT/README.md, OUT/rows.csv, and under OUT/figures every
# picture as SVG with a PNG preview, its numbers and its script. Any subset of the runs will do: the page says what is
# missing. Make the runs with cases/table1.toml, table2.toml, period_question.toml, sensitivity.toml,
# sensitivity_moment.toml and divergence.toml; several seeds of a run may lie side by side.
# Usage: scripts/paper_report.sh RUNS [OUT [build folder]]      The default of OUT is validation/paper.
set -euo pipefail
export LC_ALL=C.UTF-8

if [ $# -lt 1 ] || [ $# -gt 3 ]; then
  echo "usage: scripts/paper_report.sh RUNS [OUT [build folder]]" >&2
  exit 2
fi
source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
runs=$1
out=${2:-$source_folder/validation/paper}
gem=${3:-$source_folder/build}/gem
if ! [ -x "$gem" ]; then
  echo "no $gem (not built) run: cmake --workflow --preset default" >&2
  exit 2
fi
"$gem" paper "$runs" --out "$out" --statements "$source_folder/validation/paper/paper.json"

# The same scripts draw the previews on gnuplot's other terminal.
if ! gnuplot -e 'set terminal pngcairo' >/dev/null 2>&1; then
  echo "no PNG previews: this gnuplot has no pngcairo terminal" >&2
  exit 0
fi
find "$out/figures" -name '*.gp' | sort | while read -r script; do
  (cd "$(dirname "$script")" &&
    sed -e 's/^set terminal svg size \([0-9]*\),\([0-9]*\) dynamic/set terminal pngcairo size \1,\2/' \
      -e "s/^\(set output '.*\)\.svg'/\1.png'/" "$(basename "$script")" | gnuplot -d)
done

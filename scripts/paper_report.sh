#!/usr/bin/env bash
# Judges the paper's statements with run files and summaries. Writes OUT/README.md, OUT/rows.csv, and under OUT/figures every
# picture as SVG with a PNG preview, its data and its script. Any subset of the runs is accepted; the page says what is missing.
# scripts/paper_runs.sh makes the runs and their summaries (`gem_paper collect`). Several seeds of a run may be given. A run
# given twice counts once; with another state hash the first is kept. The rows of the program unordered_sums beside
# validation/paper/paper.json are used too.
# Usage: scripts/paper_report.sh [-o OUT] [-b BUILD_FOLDER] [FOLDER...]      The default of OUT is validation/paper.
#   FOLDER  of run files and summaries, or of archives of them (*.tar.xz, needs xz); left out: bench/results/paper, whose
#           summaries were made on a GPU. Pictures of fields need run files.
set -euo pipefail
export LC_ALL=C.UTF-8

source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$source_folder/validation/paper
judge=$source_folder/build/gem_paper
while getopts o:b: option; do
  case $option in
  o) out=$OPTARG ;;
  b) judge=$OPTARG/gem_paper ;;
  *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -ge 1 ] || set -- "$source_folder/bench/results/paper"
if ! [ -x "$judge" ]; then
  echo "no $judge (not built); run: cmake --preset default && cmake --build build --target gem_paper" >&2
  exit 2
fi

unpacked=$(mktemp -d)
trap 'rm -rf "$unpacked"' EXIT
folders=()
for folder; do
  folders+=("$folder")
  for archive in "$folder"/*.tar.xz; do
    [ ! -e "$archive" ] || tar -C "$unpacked" -xJf "$archive"
  done
done
[ -z "$(ls -A "$unpacked")" ] || folders+=("$unpacked")
"$judge" judge "${folders[@]}" --out "$out" --statements "$source_folder/validation/paper/paper.json"

# The same scripts draw the previews with another terminal of gnuplot.
if ! gnuplot -e 'set terminal pngcairo' >/dev/null 2>&1; then
  echo "no PNG previews: this gnuplot has no pngcairo terminal" >&2
  exit 0
fi
find "$out/figures" -name '*.gp' | sort | while read -r script; do
  (cd "$(dirname "$script")" &&
    sed -e 's/^set terminal svg size \([0-9]*\),\([0-9]*\) dynamic/set terminal pngcairo size \1,\2/' \
      -e "s/^\(set output '.*\)\.svg'/\1.png'/" "$(basename "$script")" | gnuplot -d)
done

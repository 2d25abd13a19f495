#!/usr/bin/env bash
# Checks the layout of every C++ file against .clang-format. Exit code 77: no clang-format 14, so nothing was checked.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool=
for candidate in clang-format-14 clang-format; do
  # Another version lays the same file out differently, so it would report faults that are none.
  if [[ "$("$candidate" --version 2>/dev/null)" =~ version\ 14\. ]]; then
    tool=$candidate
    break
  fi
done
if [ -z "$tool" ]; then
  echo "skipped: clang-format 14 is not installed (package clang-format-14)"
  exit 77
fi

mapfile -t files < <(find gem baseline_box2d validation bench -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' \) -print | sort)
[ "${#files[@]}" -gt 0 ] || { echo "no C++ files under $PWD" >&2 && exit 2; }
if ! "$tool" --dry-run --Werror --ferror-limit=1 "${files[@]}"; then
  echo "layout: run '$tool -i' on the files above"
  exit 1
fi
echo "layout: ${#files[@]} files follow .clang-format"

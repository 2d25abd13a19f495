#!/usr/bin/env bash
# First command: installs missing packages, builds, runs the main case (004_400_25, two hours of drift) and makes its report.
# Arguments go to `gem run`, e.g. scripts/run.sh --set run.duration_s=600
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

run_file=runs/004_400_25.h5
report_folder=runs/004_400_25_report

install_missing run
mapfile -t options < <(program_only)
build_targets "${options[@]}" gem
mkdir -p runs
# The run file belongs to this script, so a second call may replace it.
phase "run cases/004_400_25.toml" build/gem run cases/004_400_25.toml --out "$run_file" --overwrite "$@"
phase "report" build/gem report "$run_file" --out "$report_folder"
print_phase_times
say "run file: $root/$run_file"
say "page:     $root/$report_folder/index.html (open it in a browser)"

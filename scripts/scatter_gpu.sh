#!/bin/bash
# Where the scatter of the loads in the paper's 36 runs comes from: makes cases/table1_short_draws.toml in chunks of draws, all
# conditions in each, as long as time is left, and writes the shares of what is made. Run it again to continue after a stop.
# Usage: scripts/scatter_gpu.sh GEM OUT SECONDS
#   GEM      the program gem
#   OUT      gets runs/ (some 3 MB a run), shares.json, runs.csv, log and result.tar.xz with the last three
#   SECONDS  wall time in all; a chunk begins only if the last one's time and GEM_SPARE are left
# Environment: GEM_RUN="--engine cuda" options of `gem sweep run`;  GEM_CHUNK=5 draws a chunk;  GEM_SPARE=90 for the shares [s]
# The page: python3 scripts/studies scatter36 OUT
# Exit code: 0 the shares are made, 2 usage error, else that of `gem sweep sensitivity`.
set -euo pipefail
[ $# -eq 3 ] && [ "$3" -gt 0 ] 2>/dev/null || {
  sed -n '2,11s/^# //p' "$0" >&2
  exit 2
}
program=$(realpath "$1") seconds=$3
[ -x "$program" ] || {
  echo "$1 is no program (no such file or not executable) name the program gem" >&2
  exit 2
}
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
sweep=cases/table1_short_draws.toml conditions=36 draws=100 repeats=2
chunk=${GEM_CHUNK:-5} spare=${GEM_SPARE:-90}
read -ra options <<<"${GEM_RUN:=--engine cuda}"
note() { echo "$SECONDS s: $*" | tee -a "$out/log"; }

# The runs are numbered by condition, then draw, then repeat.
indices() {
  local condition first=$1 last=$2 list=
  for ((condition = 0; condition < conditions; ++condition)); do
    local before=$((condition * draws * repeats))
    list+=,$((before + (first - 1) * repeats + 1))-$((before + last * repeats))
  done
  echo "${list#,}"
}

SECONDS=0 longest=0
note "$("$program" --version | head -n 1), $sweep, $GEM_RUN"
for ((first = 1; first <= draws; first += chunk)); do
  last=$((first + chunk - 1 < draws ? first + chunk - 1 : draws))
  begin=$SECONDS
  if ((begin + longest + spare > seconds)); then
    note "no time is left for draws $first to $last"
    break
  fi
  # A chunk that meets the end is stopped; the runs that are done count.
  timeout -s TERM $((seconds - spare - begin > 1 ? seconds - spare - begin : 1)) \
    "$program" sweep run "$sweep" --out "$out/runs" --index "$(indices "$first" "$last")" "${options[@]}" --progress none \
    >>"$out/log" 2>&1 || note "draws $first to $last: not all were made"
  ((SECONDS - begin <= longest)) || longest=$((SECONDS - begin))
  note "draws $first to $last: $((SECONDS - begin)) s"
done
"$program" sweep sensitivity "$out/runs" --partial --json --out "$out/page" >"$out/shares.json" 2>>"$out/log"
cp "$out/page/runs.csv" "$out/runs.csv"
note "shares are made"
tar -C "$out" -cJf "$out/result.tar.xz" shares.json runs.csv log

#!/bin/bash
# Where the scatter of the loads in the paper's 36 runs comes from: makes cases/table1_short_draws.toml in chunks of draws, all
# conditions in each, as long as time is left, and writes the shares of what is made. Run it again to continue after a stop.
# Usage: scripts/scatter_gpu.sh GEM OUT SECONDS
#   GEM      the program gem
#   OUT      gets runs/ (some 3 MB a run), shares/ with a JSON and a CSV file for each condition, log, and result.tar.xz with both
#   SECONDS  wall time in all; a chunk begins only if the last one's time and GEM_SPARE are left
# Environment: GEM_RUN="--engine cuda" options of `gem sweep run`;  GEM_CHUNK=5 draws a chunk;  GEM_SPARE=90 for the shares [s]
#              GEM_GPUS=1 GPUs of this machine; each makes a chunk at a time
# The page: python3 scripts/studies scatter36 OUT
# Exit code: 0, also if not all was made (log says what), 2 usage error.
set -euo pipefail
[ $# -eq 3 ] && [ "$3" -gt 0 ] 2>/dev/null || {
  sed -n '2,12s/^# //p' "$0" >&2
  exit 2
}
program=$(realpath "$1") seconds=$3
[ -x "$program" ] || {
  echo "$1 is no program (no such file or not executable); name the program gem" >&2
  exit 2
}
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
sweep=cases/table1_short_draws.toml conditions=36 draws=100 repeats=2
chunk=${GEM_CHUNK:-5} spare=${GEM_SPARE:-90} gpus=${GEM_GPUS:-1}
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

# make_draws FIRST LAST: one chunk, on the GPU that CUDA_VISIBLE_DEVICES names. At the end of the time it is stopped; the runs that
# are done count.
make_draws() {
  local left=$((seconds - spare - SECONDS))
  timeout -s TERM $((left > 1 ? left : 1)) \
    "$program" sweep run "$sweep" --out "$out/runs" --index "$(indices "$1" "$2")" "${options[@]}" --progress none \
    >>"$out/log" 2>&1 || note "draws $1 to $2: not all were made"
}

SECONDS=0 longest=0
note "$("$program" --version | head -n 1), $sweep, $GEM_RUN, $gpus GPUs"
for ((first = 1; first <= draws; first += chunk * gpus)); do
  begin=$SECONDS
  if ((begin + longest + spare > seconds)); then
    note "no time is left for draws from $first on"
    break
  fi
  last=$((first - 1))
  for ((gpu = 0; gpu < gpus && last < draws; ++gpu)); do
    from=$((last + 1)) last=$((last + chunk < draws ? last + chunk : draws))
    CUDA_VISIBLE_DEVICES=$gpu make_draws "$from" "$last" &
  done
  wait
  ((SECONDS - begin <= longest)) || longest=$((SECONDS - begin))
  note "draws $first to $last: $((SECONDS - begin)) s"
done

# The shares, one condition at a time on each processor: a folder with its runs and the list of all.
shares_of() {
  local name=$1 folder
  folder=$out/by_run/$name
  mkdir -p "$folder"
  cp "$out/runs/manifest.json" "$folder"
  ln -f "$out/runs/$name"_d*.h5 "$folder"
  "$program" sweep sensitivity "$folder" --partial --json --table "$out/shares/$name.csv" >"$out/shares/$name.json" ||
    rm -f "$out/shares/$name.json"
}
export -f shares_of
export out program
rm -rf "$out/by_run" "$out/shares"
mkdir -p "$out/shares"
for run in "$out"/runs/*_d*.h5; do
  name=${run##*/}
  echo "${name%%_d*}"
done | sort -u | xargs -P "$(nproc)" -I NAME bash -c 'shares_of NAME' >>"$out/log" 2>&1 || note "not all shares were made"
note "shares are made"
tar -C "$out" -cJf "$out/result.tar.xz" shares log

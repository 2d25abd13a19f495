#!/bin/bash
# What pages say of speed, error and hard cases, measured again on one quiet machine in the time that there is. Needs bash, taskset,
# python3 and the files packed by scripts/pack_measurements.sh.
# Usage: scripts/measure_all.sh PROGRAMS OUT PROCESSORS SECONDS [PART...]
#   PROGRAMS    folder with the packed programs; scatter needs gem_cuda among them
#   OUT         gets all.tar.gz: its folder results is what `scripts/studies take OUT/all.tar.gz` takes. To continue elsewhere, unpack it
#               in OUT first
#   PROCESSORS  to use; timed parts use one process for each core of them
#   SECONDS     wall time in all. What is not finished then is left out; run it again in the same OUT to continue
#   PART        those wanted, of: factor hard windows closed_form speed ensembles ensembles:PART scatter; default: all
# scatter uses the GPU and the first core all the time. The others come in this order: factor on two cores for each run, hard beside
# it; then windows, closed_form and speed, one process a core; then the ensembles, one process a processor.
# Environment: as for scripts/measure.sh; GEM_FACTOR_S=900 seconds of each run at 0.25 m/s for factor, less at higher speed
#              GEM_CORES="0,8 1,9" processors of each core, in place of what the machine tells; GEM_HARD='*H3*' only these hard cases
# Exit code: 0 all is done, 2 wrong use, 8 something is left.
set -euo pipefail
[ $# -ge 4 ] && [ "$3" -ge 2 ] && [ "$4" -gt 0 ] || {
  sed -n '2,17s/^# //p' "$0" >&2
  exit 2
}
programs=$(realpath "$1") processors=$3 seconds=$4
mkdir -p "$2/results" "$2/hard" "$2/factor"
out=$(realpath "$2")
shift 4
[ $# -gt 0 ] || set -- factor hard windows closed_form speed ensembles scatter
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/workers.sh
begin=$(date +%s)
export GEM_DEADLINE=$((begin + seconds - 15)) GEM_WINDOWS=${GEM_WINDOWS:-12} GEM_WINDOW_S=${GEM_WINDOW_S:-4} GEM_DRIFT_M=${GEM_DRIFT_M:-240}
note() { echo "$(($(date +%s) - begin)) s: $*" | tee -a "$out/results/progress.txt"; }

# The processors of each core, a core a line; in pairs if the machine does not tell.
cores_of_machine() {
  local cpu lists=/sys/devices/system/cpu/cpu
  for ((cpu = 0; cpu < processors; ++cpu)); do
    cat "$lists$cpu/topology/thread_siblings_list" 2>/dev/null || echo "$cpu"
  done | sort -t, -k1,1n -u
}

# Without word of shared cores every two processors count as one: on rented machines they mostly are.
pairs() {
  if grep -q '[,-]' <<<"$1"; then echo "$1"; else paste -d, - - <<<"$1"; fi
}

mapfile -t cores < <(if [ -n "${GEM_CORES:-}" ]; then tr ' ' '\n' <<<"$GEM_CORES"; else pairs "$(cores_of_machine)"; fi)
unset GEM_CORES
wanted() { [[ " ${parts[*]} " == *" $1 "* ]]; }
parts=("$@")
free=0 # the first core that is free
: >"$out/left.txt"

if wanted scatter; then
  free=1
  taskset -c "${cores[0]}" bash scripts/scatter_gpu.sh "$programs/gem_cuda" "$out/scatter" $((seconds - 20)) \
    >"$out/scatter.log" 2>&1 || note "scatter failed (scatter.log)" &
fi

# factor INDEX CORE CORE: one run of Table 1 on two cores, three times
factor() {
  local table=$out/factor/$1.csv
  [ ! -e "$table" ] || return 0
  taskset -c "$2,$3" timeout $((GEM_DEADLINE - $(date +%s))) python3 scripts/studies real_time_factor "$programs/gem" \
    "$table.part" --seconds "${GEM_FACTOR_S:-900}" --threads 2 --index "$1" >"$out/factor/$1.log" 2>&1 &&
    mv "$table.part" "$table" || echo "factor $1" >>"$out/left.txt"
}

factors=()
if wanted factor; then
  for index in 27 2 1; do
    ((free + 2 <= ${#cores[@]})) || break
    factor $index "${cores[free]}" "${cores[free + 1]}" &
    factors+=($!)
    free=$((free + 2))
  done
fi

# one_hard NAME: the rows of one test
one_hard() {
  local status=0
  GEM_TABLE=$out/hard/rows.$1 limited "$programs/gem_hard_tests" --gtest_brief=1 --gtest_filter="${1//@//}" >"$out/hard/log.$1" 2>&1 ||
    status=$?
  [ $status -le 1 ] && mv "$out/hard/log.$1" "$out/hard/$1" # 1: a bound is missed, which the rows say
}

# The tests, with those first that took longest; a / of a name is an @, since each is a file too.
hard_tests() {
  local suite="" line
  "$programs/gem_hard_tests" --gtest_list_tests --gtest_filter="${GEM_HARD:-*}-*/Long*:Long*" | while IFS= read -r line; do
    case $line in
    " "*) line=${line%%#*} line=${line// /} && echo "${suite//\//@}${line//\//@}" ;;
    *) suite=${line%%#*} suite=${suite// /} ;;
    esac
  done >"$out/hard/list.txt"
  { grep -E "H7|H11|H13|H16|R2|column_of_100" "$out/hard/list.txt" || true; cat "$out/hard/list.txt"; } | awk '!seen[$0]++' >"$out/hard.txt"
}

if wanted hard; then
  hard_tests
  ((free < ${#cores[@]})) || free=1
  ( # in_parallel waits for all children
    GEM_CORES="${cores[*]:free}"
    in_parallel $((${#cores[@]} - free)) "$out/hard.txt" "$out/hard" one_hard
  )
  xargs -I NAME cat "$out/hard/rows.NAME" <"$out/hard.txt" >"$out/results/hard_rows.csv" 2>/dev/null || true
  while read -r name; do [ -e "$out/hard/$name" ] || echo "hard $name"; done <"$out/hard.txt" >>"$out/left.txt"
  note "hard cases end"
fi
[ ${#factors[@]} -eq 0 ] || wait "${factors[@]}" || true
if compgen -G "$out/factor/*.csv" >/dev/null; then
  awk 'FNR > 1 || NR == 1' "$out"/factor/*.csv >"$out/results/real_time_factor.csv"
fi
note "factors end"

# measure.sh makes what is left of the time; its workers stay on the cores that scatter leaves.
first=0
if wanted scatter; then first=1; fi
timed=() ensembles=()
for part in "${parts[@]}"; do
  case $part in
  windows | closed_form | speed | paths) timed+=("$part") ;;
  ensembles | ensembles:*) ensembles+=("$part") ;;
  esac
done
left() { echo "$*: $(wc -l <"$out/unfinished.txt") tasks" >>"$out/left.txt"; }
if [ ${#timed[@]} -gt 0 ]; then
  GEM_CORES="${cores[*]:first}" GEM_TIMED=$((${#cores[@]} - first)) sh scripts/measure.sh "$programs" "$out" "$processors" "${timed[@]}" ||
    left "${timed[@]}"
  note "timed parts end"
fi
if [ ${#ensembles[@]} -gt 0 ] && [ "$(date +%s)" -lt "$GEM_DEADLINE" ]; then
  sh scripts/measure.sh "$programs" "$out" $((processors - 2 * first)) "${ensembles[@]}" || left "${ensembles[@]}"
  note "ensembles end"
fi
wait
if wanted scatter; then cp "$out/scatter/result.tar.xz" "$out/results/scatter36.tar.xz" || echo scatter >>"$out/left.txt"; fi
{
  lscpu 2>/dev/null || true
  nvidia-smi -L 2>/dev/null || true
  echo "cores: ${cores[*]}"
} >"$out/results/machine.txt"
cp "$out/left.txt" "$out/results/"
mkdir -p "$out/tasks" "$out/ensembles"
tar -C "$out" -czf "$out/all.tar.gz" --exclude='*.h5' --exclude='taken.*' results hard factor tasks ensembles
note "done; not finished: $(wc -l <"$out/left.txt") lines of left.txt; $out/all.tar.gz"
[ ! -s "$out/left.txt" ] || exit 8

#!/usr/bin/env bash
# Fuzzes all targets side by side on a machine with many processors: scripts/fuzz_many.sh PROGRAMS CORPUS PROCESSES SECONDS OUT
# PROGRAMS is the folder with the built targets and words.dict (build-fuzz); CORPUS has one folder of seeds for each target (gem/fuzz/corpus).
# The processes are shared evenly. Those of one target share what they find, and a process that ends with a fault is started again.
# FUZZ_SEED of the environment starts other random numbers.
# Ends within SECONDS and the time of the merge, 60 s or MERGE_SECONDS of the environment, and 10 s.
# Writes one file: OUT/fz.tar with table.txt, the inputs that showed a fault, the ends of their logs and the inputs that reach new code.
set -euo pipefail

[ "$#" -eq 5 ] || {
  echo "usage: scripts/fuzz_many.sh PROGRAMS CORPUS PROCESSES SECONDS OUT" >&2
  exit 2
}
programs=$(cd "$1" && pwd)
corpus=$(cd "$2" && pwd)
processes=$3
seconds=$4
out=$(mkdir -p "$5" && cd "$5" && pwd)
targets=(run_file summary sweep case set csv geojson)  # the slow ones come first: they get the processes that are left over
TMPDIR=$(mktemp -d -p "$([ -d /dev/shm ] && echo /dev/shm || echo /tmp)")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
end=$(($(date +%s) + seconds))

# options_of TARGET: as in scripts/fuzz.
options_of() {
  case $1 in
    run_file | summary) echo "-detect_leaks=0 -max_len=16384 -timeout=60" ;;
    sweep) echo "-max_len=2048 -timeout=120" ;;
    *) echo "-max_len=4096 -timeout=60" ;;
  esac
}

# one TARGET NUMBER: one process until the end; again with another seed after a fault.
one() {
  local target=$1 number=$2 turn=0 left work=$TMPDIR/$1-$2 TIMEFORMAT='%R %U %S'
  mkdir -p "$work"
  while left=$((end - $(date +%s))) && [ "$left" -gt 1 ] && [ "$turn" -lt 500 ]; do
    turn=$((turn + 1))
    # shellcheck disable=SC2046  # the options are words
    { time env TMPDIR="$work" timeout -k 2 $((left + 5)) nice -n 19 "$programs/gem_fuzz_$target" $(options_of "$target") \
      -max_total_time="$left" -dict="$programs/words.dict" -rss_limit_mb=3000 -close_fd_mask=3 \
      -print_final_stats=1 -reload=10 -seed=$((${FUZZ_SEED:-0} + number * 1000 + turn)) -artifact_prefix="$TMPDIR/faults/$target-" \
      "$TMPDIR/found/$target" "$corpus/$target" >"$work/log-$turn.txt" 2>&1 || true; } 2>>"$TMPDIR/spent/$target"
    grep -q 'Test unit written' "$work/log-$turn.txt" && tail -c 6000 "$work/log-$turn.txt" >"$TMPDIR/faults/log-$target-$number-$turn.txt"
  done
}

# merge TARGET: the smallest set of found inputs that reaches what the seeds do not.
merge() {
  mkdir -p "$TMPDIR/new/$1" "$TMPDIR/merge-$1"
  cp "$corpus/$1"/* "$TMPDIR/new/$1"
  # shellcheck disable=SC2046
  env TMPDIR="$TMPDIR/merge-$1" timeout "${MERGE_SECONDS:-60}" "$programs/gem_fuzz_$1" $(options_of "$1") -rss_limit_mb=3000 \
    -close_fd_mask=3 -merge=1 "$TMPDIR/new/$1" "$TMPDIR/found/$1" >"$TMPDIR/merge-$1/log" 2>&1 || true
  for seed in "$corpus/$1"/*; do rm -f "$TMPDIR/new/$1/$(basename "$seed")"; done
}

# row TARGET: what all its processes did.
row() {
  local spent executions coverage
  spent=$(awk '{ wall += $1; processor += $2 + $3 } END { printf "%15.0f %17.0f", wall, processor }' "$TMPDIR/spent/$1")
  executions=$(cat "$TMPDIR/$1"-*/log-*.txt | awk '/^#[0-9]/ { sub("#", "", $1); last = $1 } /^INFO: Seed/ { n += last; last = 0 } END { print n + last }')
  coverage=$(cat "$TMPDIR/$1"-*/log-*.txt | sed -n "s/.*cov: \([0-9]*\).*/\1/p" | awk '$1 > n { n = $1 } END { print n + 0 }')
  printf '%-10s %s %12s %10s %8s %8s\n' "$1" "$spent" "$executions" "$coverage" \
    "$(find "$TMPDIR/new/$1" -type f | wc -l)" "$(find "$TMPDIR/faults" -name "$1-*" | wc -l)"
}

mkdir -p "$TMPDIR"/{faults,spent,found,new}
for target in "${targets[@]}"; do mkdir -p "$TMPDIR/found/$target"; done
for ((n = 0; n < processes; n++)); do one "${targets[n % ${#targets[@]}]}" "$n" & done
wait
for target in "${targets[@]}"; do merge "$target" & done
wait
{
  echo "$(date -u +%F), $processes processes for $seconds s, $(nproc) processors:$(sed -n 's/^model name[^:]*://p' /proc/cpuinfo | head -n 1)"
  printf '%-10s %15s %17s %12s %10s %8s %8s\n' target process-seconds processor-seconds executions coverage seeds faults
  for target in "${targets[@]}"; do if [ -e "$TMPDIR/spent/$target" ]; then row "$target"; fi; done
} | tee "$TMPDIR/table.txt"
tar -C "$TMPDIR" -cf "$out/fz.tar" table.txt faults new

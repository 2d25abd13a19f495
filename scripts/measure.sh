#!/bin/sh
# Measures speed against error, real-time factors and ensembles on a quiet machine. Needs sh and the files packed by
# scripts/pack_measurements.sh. Run it again to continue after a stop.
# Usage: scripts/measure.sh PROGRAMS OUT JOBS [PART...]
#   PROGRAMS  folder with the programs that `gem_measurements` builds
#   OUT       gets results.tar.gz: the tables in results/ and all finished tasks. To continue elsewhere, unpack it in OUT first
#   JOBS      processors to use
#   PART      closed_form paths windows speed ensembles; default: all, in this order. Ensembles always come last;
#             ensembles:agreement and the like run one part of the plan
# Environment: GEM_TIMED=14 processors for timed tasks, so that each has a core of its own; default: JOBS less two
#              GEM_WINDOWS=20 of each regime, GEM_WINDOW_S=32 long (a multiple of 4), one every
#              GEM_SPACING_S=32
#              GEM_MINUTES=9 stop after this time, with what is finished
#              GEM_DRIFT_M=600 drift distance for speed; GEM_WHOLE=1 speed over whole runs
#              GEM_QUICK=1 a rehearsal in minutes; its numbers mean nothing
# Exit code: 0 all is done, 2 wrong use, 8 something is left: run it again.
#
# Cost of the tasks in seconds of one processor of a busy machine. A window of 8 s: jam 320 to 380 (its reference alone takes 22
# per second), plug 110, drift 15. A window of 32 s: 1190, 300, 23. Closed forms: 42. Speed over 240 m: 50 to 130 per run of the
# paper, 90 with 64128 floes. A member of an ensemble: 30 to 95 (gem), 75 to 220 (Box2D), 1.6 times that with 20 iterations.
# With 28 processors, 14 of them for speed, in 18 minutes:
#   GEM_TIMED=14 GEM_DRIFT_M=240 GEM_MINUTES=6 scripts/measure.sh bin OUT 28 closed_form speed
#   GEM_TIMED=28 GEM_WINDOW_S=8 GEM_MINUTES=12 scripts/measure.sh bin OUT 28 windows ensembles:agreement ensembles:experiment
set -eu
[ $# -ge 3 ] || {
  sed -n '2,16s/^# //p' "$0" >&2
  exit 2
}
mkdir -p "$2/results"
programs=$(cd "$1" && pwd) out=$(cd "$2" && pwd) jobs=$3
shift 3
[ $# -gt 0 ] || set -- closed_form paths windows speed ensembles
cd "$(dirname "$0")/.."
. scripts/workers.sh
results=$out/results
timed=${GEM_TIMED:-$((jobs > 2 ? jobs - 2 : 1))}
if [ -n "${GEM_MINUTES:-}" ]; then
  GEM_DEADLINE=$(($(date +%s) + 60 * GEM_MINUTES))
  export GEM_DEADLINE
fi
quick=${GEM_QUICK:-0}

# choice QUICK FULL
choice() { if [ "$quick" = 1 ]; then echo "$1"; else echo "$2"; fi; }

note() { echo "$*" | tee -a "$results/conditions.txt"; }

conditions() {
  note "begun $(date -u +%Y-%m-%dT%H:%M:%SZ): $*"
  note "machine $(uname -sm), $(grep -c ^processor /proc/cpuinfo) x$(sed -n 's/^model name[^:]*://p' /proc/cpuinfo | head -n 1)"
  note "load $(cut -d' ' -f1-3 /proc/loadavg), jobs $jobs, timed jobs $timed, quick $quick"
  note "program $("$programs/gem" --version | tr '\n' ' ')"
  note "windows of ${GEM_WINDOW_S:-32} s, one every ${GEM_SPACING_S:-32} s"
}

# task LINE: name, program and its arguments, separated by tabs; it writes the files $out/tasks/NAME.*
task() {
  tab=$(printf '\t')
  name=${1%%"$tab"*}
  (
    set -f
    IFS=$tab
    # shellcheck disable=SC2086
    set -- ${1#*"$tab"}
    program=$1
    shift
    limited "$programs/$program" "$@" >"$out/tasks/$name.log" 2>&1
  ) || {
    cat "$out/tasks/$name.log" >&2
    return 1
  }
  : >"$out/tasks/$name"
}

# in_tabs NAME PROGRAM ARGUMENT...
in_tabs() {
  line=$1
  shift
  for word; do line=$line$(printf '\t')$word; done
  printf '%s\n' "$line"
}

# together RESULT FILE...: one table with one header from the finished tasks
together() {
  result=$1
  shift
  rm -f "$result"
  for table; do
    [ -e "${table%.*}" ] || continue
    [ -e "$result" ] || head -n 1 "$table" >"$result"
    tail -n +2 "$table" >>"$result"
  done
}

# 5 cm of drift a time step; settings state theirs relative to it
sweep=validation/baseline/table1_5cm.toml

# regimes: name, case, first start [s]; one task for each window
regimes() {
  echo "jam $sweep#27 600"
  echo "plug $sweep#24 600"
  echo "drift $sweep#1 60"
}

# Each part prints its tasks.
closed_form() {
  moments=$(choice 0.2,0.1 0.4,0.2,0.1,0.05,0.025,0.0125,0.00625)
  in_tabs closed_form closed_form_errors bench/closed_form_settings.txt "$moments" "$out/tasks/closed_form.csv"
}

# The regime with the longest tasks goes first, so that none is left at the end.
windows() {
  seconds=${GEM_WINDOW_S:-32}
  grep -v step_factor=8 bench/window_settings.txt >"$out/short_settings.txt"
  regimes | while read -r regime case start; do
    settings=bench/window_settings.txt k=0
    [ "$regime" != drift ] || settings=$out/short_settings.txt # eight of its time steps do not divide 4 s
    while [ "$k" -lt "$(choice 1 "${GEM_WINDOWS:-20}")" ]; do
      name=windows_${regime}_$k
      in_tabs "$name" window_errors "$case" "$regime" "$(choice 20 $((start + ${GEM_SPACING_S:-32} * k)))" "$(choice 1 $((seconds / 4)))" \
        1 "$(choice 4 "$seconds")" "$(choice 2 $((seconds / 4)))" 0 "$settings" "$out/tasks/$name.errors" \
        "$out/tasks/$name.paths"
      k=$((k + 1))
    done
  done
}

paths() {
  regimes | while read -r regime case start; do
    name=paths_$regime
    in_tabs "$name" window_errors "$case" "$regime" "$(choice 20 "$start")" "$(choice 1 10)" 1 "$(choice 4 200)" \
      "$(choice 2 50)" 0 bench/path_settings.txt "$out/tasks/$name.errors" "$out/tasks/$name.paths"
  done
}

# speed_of NAME CASE UNTIL_S
speed_of() {
  [ "${GEM_WHOLE:-0}" = 0 ] || set -- "$1" "$2" 0
  in_tabs "speed_$1" paired_speed "$2" bench/speed_pairs.txt "$(choice 2 24)" "$(choice 4 "$3")" "$out/tasks/speed_$1.csv"
}

# Ice of the main case in fields of other sizes, the 36 runs of Table 1, and the other five of Table 2; the longest first.
speed() {
  drift=${GEM_DRIFT_M:-600}
  for size in $(choice "" "64128_6000_1600 16032_3000_800") 4008_1500_400 1002_750_200; do
    # shellcheck disable=SC2046
    set -- $(echo "$size" | tr _ ' ')
    in_tabs "speed_growth_$1" paired_speed "$sweep#2" bench/speed_pairs.txt "$(choice 2 12)" \
      "$(choice 2 $((drift / 5)))" "$out/tasks/speed_growth_$1.csv" "growth" "floes.count=$1" "floes.length_m=$2" \
      "floes.width_m=$3" "floes.start_x_m=-$(($2 + 75))" "boundary.inlet_x_m=-$(($2 + 100))" \
      "boundary.taper_start_x_m=-$(($2 + 100))" "boundary.inlet_width_m=$3" "boundary.gap_m=$3"
  done
  k=1
  while [ "$k" -le "$(choice 2 36)" ]; do
    # 0.25, 0.5 and 1 m/s in turn
    case $((k % 3)) in 1) until=$((4 * drift)) ;; 2) until=$((2 * drift)) ;; *) until=$drift ;; esac
    speed_of "1_$k" "$sweep#$k" "$until"
    k=$((k + 1))
  done
  k=2
  while [ "$k" -le "$(choice 2 6)" ]; do
    speed_of "2_$k" "cases/table2.toml#$k" $((4 * drift))
    k=$((k + 1))
  done
}

ensembles() {
  if [ "$quick" = 1 ]; then
    # as the plan, but three members of one case, judged from 5 s to 65 s
    sed -e 's/^\(part | [a-z]* |\).*/\1 3 | 400_300_100/' -e 's/^\(case |[^|]*|[^|]*|[^|]*|\).*/\1 5 | 65/' \
      validation/baseline/ensembles.txt >"$out/plan.txt"
    GEM_PLAN=$out/plan.txt
    export GEM_PLAN
  fi
  # what it leaves unfinished (8) is counted at the end
  scripts/ensembles.sh "$programs" "$out/ensembles" "$jobs" "$@" || [ $? -eq 8 ]
  cp "$out/ensembles/ensembles.csv" "$out/ensembles/map_means.csv" "$results"
  cp "$out/ensembles/rows.csv" "$results/ensemble_rows.csv"
}

conditions "$@"
# Timed tasks go first and in one list, so that no core waits for the end of a part.
: >"$out/tasks.txt"
for part; do
  case $part in
  closed_form | windows | paths | speed) $part >>"$out/tasks.txt" ;;
  ensembles | ensembles:*) ;;
  *)
    echo "measure.sh: unknown part '$part' (parts: closed_form windows paths speed ensembles ensembles:PART)" >&2
    exit 2
    ;;
  esac
done
in_parallel "$timed" "$out/tasks.txt" "$out/tasks" task
together "$results/closed_form_errors.csv" "$out"/tasks/closed_form.csv
together "$results/windows.csv" "$out"/tasks/windows_*.errors
together "$results/paths.csv" "$out"/tasks/paths_*.paths
together "$results/speed.csv" "$out"/tasks/speed_*.csv
note "timed parts ended $(date -u +%H:%M:%S), load $(cut -d' ' -f1-3 /proc/loadavg)"
wanted=0 parts=
for part; do # one list of all, so that no processor waits between parts
  case $part in
  ensembles) wanted=1 ;;
  ensembles:*) wanted=1 parts="$parts ${part#ensembles:}" ;;
  esac
done
# shellcheck disable=SC2086
[ "$wanted" = 0 ] || ensembles $parts
note "ended $(date -u +%H:%M:%S), load $(cut -d' ' -f1-3 /proc/loadavg)"

# The tasks still to be done, by name.
{
  cut -f1 "$out/tasks.txt" | while IFS= read -r name; do [ -e "$out/tasks/$name" ] || echo "$name"; done
  [ ! -e "$out/ensembles/list.txt" ] || cut -f1 "$out/ensembles/list.txt" | while IFS= read -r name; do
    [ -e "$out/ensembles/members/$name" ] || echo "$name"
  done
} >"$out/unfinished.txt"
mkdir -p "$out/tasks" "$out/ensembles"
tar -C "$out" -czf "$out/results.tar.gz.part" --exclude='*.h5' --exclude='taken.*' results tasks ensembles
mv "$out/results.tar.gz.part" "$out/results.tar.gz"
echo "$(wc -l <"$out/unfinished.txt") tasks are not finished ($out/unfinished.txt); $out/results.tar.gz"
[ ! -s "$out/unfinished.txt" ] || exit 8

#!/bin/sh
# All runs of the paper's reproduction, most telling first, and what `gem_paper judge` needs of them in a few small files.
# Needs sh, tar and two programs; run it again to go on after a stop: what is done stays.
# Usage: scripts/paper_runs.sh GEM OUT [PART...]
#   GEM   the program gem; gem_paper lies beside it
#   OUT   gets runs/ (run files), summaries/ (what `gem_paper collect` makes of them) and paper_1.tar.gz, paper_2.tar.gz, ...
#         with the summaries, none larger than 15 MiB
#   PART  seeds:1-10 (these seeds of table1_seeds.toml), open:1-10 (but for the 200 m gap, which takes longest), table2
#         period_question sensitivity sensitivity_moment divergence day, day:2 (its second run alone); left out: all, in an
#         order of importance
# Environment: GEM_MINUTES=9 stop after so long, with what is finished packed
#              GEM_RUN="--engine cuda" options of `gem sweep run`;  GEM_JOBS=16 processes that collect
#              GEM_QUICK=1 a rehearsal with few floes in minutes on a CPU, whose numbers mean nothing
# Exit code: 0 all is done, 2 usage error, 8 some parts are not finished: run it again.
# Then, where the report is made: tar xzf each into DIR; scripts/paper_report.sh DIR [folders of run files]
set -eu
[ $# -ge 2 ] || {
  sed -n '2,17s/^# //p' "$0" >&2
  exit 2
}
usage_error() {
  echo "$1" >&2
  exit 2
}
if [ ! -f "$1" ] || [ ! -x "$1" ]; then usage_error "$1 is no program (no such file or not executable); name the program gem"; fi
program=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
judge=$(dirname "$program")/gem_paper
[ -x "$judge" ] || usage_error "no $judge (not built); build gem_paper and put it beside $program"
folder=$2
shift 2
quick=${GEM_QUICK:-0}
[ $# -gt 0 ] || if [ "$quick" = 1 ]; then
  set -- seeds:1-2 table2 period_question seeds:3-4 sensitivity sensitivity_moment divergence day
else
  set -- seeds:1-10 table2 period_question seeds:11-20 sensitivity sensitivity_moment divergence seeds:21-30 day
fi

is_part() {
  case $1 in
  seeds:* | open:*)
    span=${1#*:}
    first=${span%%-*} last=${span#*-}
    case $span in *-*) ;; *) return 1 ;; esac
    case $first$last in *[!0-9]*) return 1 ;; esac
    case $first in '' | 0*) return 1 ;; esac
    case $last in '' | 0* | ???*) return 1 ;; esac
    [ "$first" -le "$last" ] && [ "$last" -le 30 ]
    ;;
  table2 | period_question | sensitivity | sensitivity_moment | divergence | day | day:[1-3]) ;;
  *) return 1 ;;
  esac
}
for part; do
  is_part "$part" || usage_error "$part is no part (its name or its seeds, 1 to 30); see the top of $0"
done

mkdir -p "$folder/runs" "$folder/summaries" "$folder/lists"
out=$(cd "$folder" && pwd)
cd "$(dirname "$0")/.."
. scripts/workers.sh
jobs=${GEM_JOBS:-$(grep -c ^processor /proc/cpuinfo)}
collecting=45        # seconds kept at the end for collecting and packing
largest_pack=15000000 # bytes
if [ -n "${GEM_MINUTES:-}" ]; then
  end=$(($(date +%s) + 60 * GEM_MINUTES))
  run_until=$((end - collecting))
fi

note() { echo "$(date -u +%H:%M:%S) $*" | tee -a "$out/summaries/conditions.txt"; }

# Settings of a rehearsal: a small field close to the platform, long enough for a spectrum.
quick_settings() {
  [ "$quick" = 1 ] || return 0
  duration=1200
  [ "$1" != day ] || duration=3600
  for setting in "run.duration_s=$duration.0" floes.count=30 floes.length_m=30.0 floes.width_m=200.0 floes.start_x_m=-85.0 \
    'floes.placement="random"' boundary.inlet_x_m=-130.0 boundary.taper_start_x_m=-130.0 boundary.inlet_width_m=200.0 \
    numerics.time_step_s=0.2 output.platform_interval_s=0.8; do
    echo "--set=$setting"
  done
  [ "$1" != divergence ] || echo --set=floes.moved_floe=5
}

sweep_of() { case $1 in seeds:* | open:*) echo table1_seeds ;; *) echo "${1%%:*}" ;; esac; }

# Conditions of a part, counted from 0, in groups of three: gaps of 400, 300 and 200 m.
conditions_of() {
  condition=0
  while [ "$condition" -lt 36 ]; do
    case $1/$((condition / 3 % 3)) in open:*/2) ;; *) echo "$condition" ;; esac
    condition=$((condition + 1))
  done
}

# Runs of a part as a list for --index; empty: all. The thirty seeds of a condition are consecutive.
index_of() {
  case $1 in
  seeds:* | open:*)
    span=${1#*:}
    for condition in $(conditions_of "$1"); do
      printf '%s%d-%d' "$([ "$condition" = 0 ] || echo ,)" $((30 * condition + ${span%-*})) $((30 * condition + ${span#*-}))
    done
    ;;
  day:*) printf '%s' "${1#*:}" ;;
  esac
}

# pieces PART RUNS OPTION...: collects a sweep in pieces of this many runs, so that all processors are busy
pieces() {
  name=$1 step=$2
  shift 2
  count=$("$program" sweep status "$out/runs/$name" --json | grep -c '"state_hash"')
  first=1
  while [ "$first" -le "$count" ]; do
    last=$((first + step - 1))
    [ "$last" -le "$count" ] || last=$count
    printf '%s_%d\t--index=%d-%d' "$name" "$first" "$first" "$last"
    printf '\t%s' "$@"
    echo
    first=$((last + 1))
  done
}

# what to collect of a part: name, then options of `gem_paper collect`, with tabs between. Paths that are to be compared to
# the last bit are kept exact; run 1 alone is compared with the null model, each seed by a process of its own.
collections() {
  case $1 in
  seeds:* | open:*)
    span=${1#*:}
    seed=${span%-*}
    while [ "$seed" -le "${span#*-}" ]; do
      printf '%s\t--index=%d\t--series=10\n' "seeds_run1_$seed" "$seed"
      seed=$((seed + 1))
    done
    for condition in $(conditions_of "$1"); do
      [ "$condition" = 0 ] || printf '%s\t--index=%d-%d\t--series=10\t--no-null-model\n' \
        "seeds_${span}_$((condition + 1))" $((30 * condition + ${span%-*})) $((30 * condition + ${span#*-}))
    done
    ;;
  table2) pieces table2 1 --exact --series=2 ;; # with the null model, which takes most of the time
  divergence) pieces divergence 4 --exact --series=5 --no-null-model ;;
  day*) pieces day 1 --series=10 --no-null-model ;;
  *) pieces "$1" 4 --series=0 --no-null-model ;;
  esac
}

# run PART: 0 if all its runs are done
run() {
  sweep=$(sweep_of "$1")
  list=$(index_of "$1")
  # shellcheck disable=SC2046,SC2086
  set -- sweep run "cases/$sweep.toml" --out "$out/runs/$sweep" --progress none $(quick_settings "$sweep") ${GEM_RUN:-}
  [ -z "$list" ] || set -- "$@" --index "$list"
  case $sweep in
  table2) set -- "$@" --set sweep.seeds.count=5 ;; # ratios of two conditions are taken seed by seed
  divergence) [ "$quick" = 1 ] || set -- "$@" --set sweep.seeds.count=20 ;;
  esac
  if [ -n "${run_until:-}" ]; then
    # an interrupt ends a run in order; a limit of 0 would be none
    seconds=$((run_until - $(date +%s)))
    timeout -s INT -k 20 $((seconds > 0 ? seconds : 1)) "$program" "$@"
  else
    "$program" "$@"
  fi
}

# collect LINE of collections. A piece of which no run is done is no fault of collecting.
collect() {
  tab=$(printf '\t')
  name=${1%%"$tab"*}
  case $1 in *"$tab"*) options=$(printf '%s' "${1#*"$tab"}" | tr '\t' ' ') ;; *) options= ;; esac
  # shellcheck disable=SC2086
  "$judge" collect "$out/runs/$collected" --out "$out/summaries/$name.h5" --overwrite --partial $options \
    >"$out/lists/$name.log" 2>&1 && return 0
  ! grep -q 'holds 0 done runs' "$out/lists/$name.log" || return 0
  rm -f "$out/summaries/$name.h5"
  cat "$out/lists/$name.log"
  return 1
}

# collect_part PART: 0 if all that is done was collected
collect_part() {
  collected=$(sweep_of "$1")
  [ -e "$out/runs/$collected/manifest.json" ] || return 0
  collections "$1" >"$out/lists/collect"
  in_parallel "$jobs" "$out/lists/collect" "$out/lists/none" collect
  # called where a failing command stops nothing: each piece must have left its file, or have no run
  cut -f1 "$out/lists/collect" | while IFS= read -r name; do
    [ -e "$out/summaries/$name.h5" ] || grep -q 'holds 0 done runs' "$out/lists/$name.log" || echo "$name"
  done >"$out/lists/not_collected"
  [ -s "$out/lists/collect" ] && [ ! -s "$out/lists/not_collected" ]
}

pack() {
  rm -f "$out"/paper_*.tar.gz
  number=1 size=0
  : >"$out/lists/pack_1"
  for file in "$out"/summaries/*; do
    own=$(wc -c <"$file")
    if [ $((size + own)) -gt $largest_pack ] && [ $size -gt 0 ]; then
      number=$((number + 1)) size=0
      : >"$out/lists/pack_$number"
    fi
    size=$((size + own))
    echo "summaries/$(basename "$file")" >>"$out/lists/pack_$number"
  done
  while [ $number -gt 0 ]; do
    tar -C "$out" -czf "$out/paper_$number.tar.gz" -T "$out/lists/pack_$number"
    number=$((number - 1))
  done
}

note "begun: $*; $("$program" --version | head -n 1); quick $quick; options ${GEM_RUN:-none}"
left=
for part; do
  if [ -n "${run_until:-}" ] && [ "$(date +%s)" -ge "$run_until" ]; then
    left="$left $part"
    continue
  fi
  note "$part"
  complete=1
  run "$part" || complete=0
  collect_part "$part" || complete=0
  [ $complete = 1 ] || left="$left $part"
done
note "left: ${left:-nothing}"
pack
ls -l "$out"/paper_*.tar.gz
[ -z "$left" ] || {
  echo "not finished:$left; run this again to continue" >&2
  exit 8
}

#!/bin/sh
# Measures what checkpoints, flushes and readers cost a run: pairs of runs with and without, in alternate order.
#
# usage: scripts/faults/cost.sh GEM CASE SECONDS PAIRS OUT.csv [OPTIONS OF GEM RUN]
#
# Of a sweep file all runs are made, by `gem sweep run`. SECONDS: run.duration_s; 0: that of the case. Three things are measured:
#   checkpoints  the default interval against none at all
#   flushes      the default interval, after which readers see the rows, against one after a second and one at the end
#   reader       `gem info` of the growing file once a second, against none; only of single runs. The reader's own time is not counted
# OUT.csv gets the processor time and the wall time of each run. Needs no more than a POSIX shell, awk, sort and Linux.
set -eu
[ $# -ge 5 ] || { sed -n '2,10p' "$0" >&2; exit 2; }
gem=$1 case=$2 seconds=$3 pairs=$4 out=$5
shift 5
folder=$(mktemp -d "${TMPDIR:-/tmp}/gem_cost.XXXXXX")
trap 'rm -rf "$folder"' EXIT
never=1000000000

command=run made=$folder/run.h5
! grep -q '^\[sweep\]' "$case" || { command="sweep run"; made=$folder/sweep; }
[ "$seconds" = 0 ] || set -- "$@" --set "run.duration_s=$seconds"

now() { awk '{ print $1 }' /proc/uptime; }

# one KIND WITH PAIR OPTIONS: a run and its row
one() {
  kind=$1 with=$2 pair=$3
  shift 3
  rm -rf "$made" "$made".checkpoint-*
  reader=
  if [ "$kind $with" = "reader yes" ]; then
    while :; do
      sleep 1
      "$gem" info "$made" --json >"$folder/info" 2>&1 || :
    done &
    reader=$!
  fi
  begun=$(now)
  # `times` of the subshell: its second line is the processor time of its children
  # shellcheck disable=SC2086
  ( "$gem" $command "$case" --out "$made" --quiet "$@" >"$folder/said" && times >"$folder/times" ) || {
    echo "cost.sh: the run failed: $gem $command $case $*" >&2
    [ -z "$reader" ] || kill "$reader"
    exit 1
  }
  ended=$(now)
  [ -z "$reader" ] || { kill "$reader"; wait "$reader" 2>/dev/null || :; }
  awk -v head="$kind,$with,$pair" -v wall="$(awk -v a="$begun" -v b="$ended" 'BEGIN { print b - a }')" '
    function in_seconds(text, part) { split(text, part, /[ms]/); return 60 * part[1] + part[2] }
    NR == 2 { printf "%s,%.2f,%.2f,%.2f\n", head, in_seconds($1), in_seconds($2), wall }' "$folder/times" >>"$out"
}

# both KIND PAIR OPTIONS: with and without, the order changes from pair to pair. Which comes first in the first pair is up to the process
# number, so that several of these scripts side by side do not all begin with the same one: a machine's speed may change in common.
both() {
  kind=$1 pair=$2
  shift 2
  order="yes no"
  [ $(((pair + $$) % 2)) = 1 ] || order="no yes"
  for side in $order; do
    case "$kind $side" in
      "checkpoints no" | "flushes yes" | "reader "*) one "$kind" "$side" "$pair" --checkpoint-every 0 "$@" ;;
      "flushes no") one "$kind" "$side" "$pair" --checkpoint-every 0 --flush-every "$never" "$@" ;;
      *) one "$kind" "$side" "$pair" "$@" ;;
    esac
  done
}

kinds=checkpoints
# shellcheck disable=SC2086
! "$gem" $command --help | grep -q -- --flush-every || kinds="$kinds flushes"
[ "$command" != run ] || kinds="$kinds reader"
"$gem" --version >&2
one warm-up no 0 --checkpoint-every 0 "$@"
echo "kind,with,pair,user_s,system_s,wall_s" >"$out"
n=1
while [ "$n" -le "$pairs" ]; do
  for kind in $kinds; do both "$kind" "$n" "$@"; done
  echo "pair $n of $pairs" >&2
  n=$((n + 1))
done

# median of the ratios with / without, and the quartiles
for kind in $kinds; do
  for what in processor wall; do
    awk -F, -v kind="$kind" -v what="$what" '
      $1 == kind { time[$3, $2] = what == "wall" ? $6 : $4 + $5 }
      $1 == kind { last = $3 }
      END { for (n = 1; n <= last; n++) if (time[n, "no"] > 0) print time[n, "yes"] / time[n, "no"] }' "$out" | sort -n |
      awk -v kind="$kind" -v what="$what" '
        { ratio[NR] = $1 }
        function at(share, place, low) { place = 1 + share * (NR - 1); low = int(place)
          return low < NR ? ratio[low] + (place - low) * (ratio[low + 1] - ratio[low]) : ratio[NR] }
        END { if (NR) printf "%-11s %-9s time, with / without: median %.4f, quartiles %.4f to %.4f, %d pairs\n",
                kind, what, at(0.5), at(0.25), at(0.75), NR }'
  done
done

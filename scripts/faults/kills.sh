#!/bin/sh
# Kills runs with SIGKILL at random moments, lets them go on, and compares their state hashes with that of a run that was left alone.
#
# usage: scripts/faults/kills.sh GEM CASE N OUT.csv [--seconds S] [--seed K] [--wall W] [OPTIONS OF GEM RUN, e.g. --engine cuda]
#
# Of a sweep file all runs are made in one folder, the whole process group is killed, and `gem sweep run` is called again. Each run is
# killed once, after a moment drawn from its whole length; one that has no checkpoint yet begins again. Kills that come too late are
# drawn again. --seconds sets run.duration_s. --wall ends the kills early, so that the script takes W seconds of wall time. These options
# stand before those of gem run.
# A row of OUT.csv: number, moment of the kill [s of wall time], how the run came to its end, wall time redone [s] (from the newest
# checkpoint to the kill, the longest of a sweep's runs), simulated time that a reader found after the kill and from which the run went
# on [s; single runs], equal hashes (yes or no).
# Exit code 1: a hash differs or a run does not come to its end. Needs a POSIX shell, awk, sort, and from Linux setsid and date -r.
set -eu
[ $# -ge 4 ] || { sed -n '2,14p' "$0" >&2; exit 2; }
gem=$1 case=$2 runs=$3 out=$4
shift 4
seed=1 allowed=
script_begun=$(date +%s)
while [ $# -gt 0 ]; do
  case $1 in
    --seconds) duration=$2 && shift 2 ;;
    --seed) seed=$2 && shift 2 ;;
    --wall) allowed=$2 && shift 2 ;;
    *) break ;;
  esac
done
folder=$(mktemp -d "${TMPDIR:-/tmp}/gem_kills.XXXXXX")
trap 'rm -rf "$folder"' EXIT

sweep=no
! grep -q '^\[sweep\]' "$case" || sweep=yes
length=${duration:+--set run.duration_s=$duration}

now() { date +%s.%N; }
less() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", b - a }'; }

# the value of a key in the JSON of `gem info`
told() { "$gem" info "$1" --json 2>/dev/null | sed -n "s/^  \"$2\": \"\{0,1\}\([^\",]*\).*/\1/p"; }

# is_late: one more kill, with the run that follows, may take more than what is left of the wall time
is_late() {
  [ -n "$allowed" ] || return 1
  awk -v past="$(($(date +%s) - script_begun))" -v wall="$wall" -v w="$allowed" 'BEGIN { exit past + 2 * wall + 2 < w }'
}

# begin PLACE OPTIONS: the run or the sweep from its start, or what is left of the sweep; in a process group of its own
begin() {
  place=$1
  shift
  # shellcheck disable=SC2086
  if [ $sweep = yes ]; then
    exec setsid "$gem" sweep run "$case" --out "$place" --quiet $length "$@"
  else
    exec setsid "$gem" run "$case" --out "$place" --overwrite --quiet $length "$@"
  fi
}

# lives GROUP: a process of the group still runs. The processes of a sweep die after their leader, and hold locks until then
lives() { cat /proc/[0-9]*/stat 2>/dev/null | awk -v g="$1" '{ sub(/^.*\) /, "") } $3 == g && $1 != "Z" { found = 1 } END { exit !found }'; }

# is_complete PLACE: all that was left alone is there and complete
is_complete() {
  hashes "$1" parts >"$folder/found"
  cmp -s "$folder/wanted" "$folder/found"
}

hashes() {
  for file in "$1" "$1"/*.h5; do
    if [ -f "$file" ]; then echo "${file##*/} $(told "$file" gem_state_hash) $(told "$file" gem_status)"; fi
  done | sed "s/^$2.h5 /run.h5 /"
}

# wall time from the newest checkpoint of each unfinished run to the kill; the longest. Without a checkpoint from the start.
redone() {
  longest=0.00
  for file in "$1" "$1"/*.h5; do
    [ -f "$file" ] || continue
    [ "$(told "$file" gem_status)" != complete ] || continue
    newest=$2
    for kept in "$file".checkpoint-?; do
      if [ -f "$kept" ]; then newest=$(printf '%s\n%s\n' "$newest" "$(date -r "$kept" +%s.%N)" | sort -n | tail -1); fi
    done
    longest=$(printf '%s\n%s\n' "$longest" "$(less "$newest" "$3")" | sort -n | tail -1)
  done
  [ -e "$1" ] || longest=$(less "$2" "$3")
  echo "$longest"
}

# go_on PLACE OPTIONS: to the end of the run. Says how: went on, begun again, or failed; then from which simulated time
go_on() {
  place=$1
  shift
  if [ $sweep = yes ]; then
    if (begin "$place" "$@") >"$folder/said" 2>&1; then echo "went on,"; else echo "failed,"; fi
  elif "$gem" run --continue "$place" --progress none "$@" >/dev/null 2>"$folder/said"; then
    echo "went on,$(sed -n 's/.* goes on from \([^ ]*\) s .*/\1/p' "$folder/said")"
  elif grep -q "no checkpoint\|no such file" "$folder/said" && (begin "$place" "$@") >"$folder/said" 2>&1; then
    echo "begun again,0"
  else
    echo "failed,"
  fi
}

"$gem" --version >&2
whole=$folder/whole
[ $sweep = yes ] || whole=$whole.h5
begun=$(now)
(begin "$whole" "$@")
wall=$(less "$begun" "$(now)")
hashes "$whole" whole >"$folder/wanted"
echo "left alone: $wall s; $(wc -l <"$folder/wanted") runs" >&2

echo "n,killed_after_s,end,redone_wall_s,read_to_s,went_on_from_s,same_hash" >"$out"
n=1 draw=0
while [ "$n" -le "$runs" ] && ! is_late; do
  draw=$((draw + 1))
  [ "$draw" -le $((10 * runs)) ] || { echo "kills.sh: the run is too short to be killed (choose another length)" >&2; exit 1; }
  parts=$folder/parts
  [ $sweep = yes ] || parts=$parts.h5
  rm -rf "$parts" "$parts".checkpoint-?
  moment=$(awk -v seed="$((10000 * seed + draw))" -v wall="$wall" 'BEGIN { srand(seed); rand(); printf "%.2f", 0.05 + rand() * wall }')
  begun=$(now)
  (begin "$parts" "$@") </dev/null >/dev/null 2>&1 &
  sleep "$moment"
  kill -9 -$! 2>/dev/null || :
  killed=$(now)
  wait $! 2>/dev/null || :
  while lives $!; do sleep 0.02; done
  if is_complete "$parts"; then continue; fi # the kill came too late
  lost=$(redone "$parts" "$begun" "$killed")
  read_to=
  [ $sweep = yes ] || read_to=$(told "$parts" end_s)
  end=$(go_on "$parts" "$@")
  same=no
  ! is_complete "$parts" || same=yes
  [ $same = yes ] || sed 's/^/  /' "$folder/said" "$folder/found" >&2
  echo "$n,$moment,${end%%,*},$lost,$read_to,${end#*,},$same" >>"$out"
  n=$((n + 1))
done

awk -F, 'NR > 1 { tried++; same += $7 == "yes"; how[$3]++ } END {
  printf "%d killed, %d with the hash of the run left alone", tried, same
  for (end in how) printf ", %d %s", how[end], end
  printf "\n" }' "$out"
awk -F, 'NR > 1 { print $4 }' "$out" | sort -n | awk '{ t[NR] = $1 } END {
  if (NR) printf "wall time redone: median %.2f s, largest %.2f s\n", t[int((NR + 1) / 2)], t[NR] }'
! grep -q ',no$' "$out"

#!/bin/sh
# Runs the ensembles of validation/baseline/ensembles.txt on any machine. Needs sh, the programs gem and gem_ensembles, and the
# folders cases/ and validation/. Run it again to continue after a stop: finished members are kept.
# Usage: scripts/ensembles.sh PROGRAMS OUT JOBS [PART...]
#   PROGRAMS  folder with gem and gem_ensembles, and gem_slop for the setting that needs it (left out without it)
#   OUT       gets rows.csv, maps.csv, ensembles.csv, map_means.csv; OUT/members holds what is finished
#   PART      of the plan: agreement, experiment, error, one after the other as given; all of them together if left out
# Environment: GEM_PLAN another plan; GEM_CASES="400_300_100" only these cases of it; GEM_KEEP=1 keeps the run files (some 10 MB each)
# Exit code: 0 all members of these parts are done, 2 wrong use, 8 some are left: run it again.
set -eu
[ $# -ge 3 ] || {
  sed -n '2,9s/^# //p' "$0" >&2
  exit 2
}
mkdir -p "$2/members"
programs=$(cd "$1" && pwd) out=$(cd "$2" && pwd) jobs=$3
cd "$(dirname "$0")/.."
shift 3
plan=${GEM_PLAN:-validation/baseline/ensembles.txt}
. scripts/workers.sh
tab=$(printf '\t')
"$programs/gem_ensembles" members "$plan" >"$out/all.txt"
if [ $# -eq 0 ]; then
  cp "$out/all.txt" "$out/list.txt"
else
  for part; do "$programs/gem_ensembles" members "$plan" "$part"; done >"$out/list.txt"
fi
if [ -n "${GEM_CASES:-}" ]; then
  for case in $GEM_CASES; do grep "^$case\." "$out/list.txt" || true; done | sort -t"$tab" -k4,4n -s >"$out/chosen.txt"
  mv "$out/chosen.txt" "$out/list.txt"
fi
# members that need gem_slop are left out without it
[ -x "$programs/gem_slop" ] || sed -i '/@slop/d' "$out/list.txt"

# one_member LINE: runs it, keeps its numbers and drops its run file
one_member() {
  name=$(printf '%s' "$1" | cut -f1) case=$(printf '%s' "$1" | cut -f2)
  setting=$(printf '%s' "$1" | cut -f3) arguments=$(printf '%s' "$1" | cut -f5)
  base=$out/members/$name program=$programs/gem
  case $arguments in
  *@slop*)
    program=$programs/gem_slop arguments=${arguments%@slop*}
    ;;
  esac
  set -f # --set values hold quotes, never blanks or patterns to expand
  # shellcheck disable=SC2086
  limited "$program" run $arguments --set output.floes_interval_s=20 --set output.event_speed_m_per_s=0 \
    --set output.hit_release_s=0 --threads 1 --quiet --overwrite \
    --out "$base.h5" 2>"$base.log" || {
    cat "$base.log" >&2
    rm -f "$base.h5"
    return 1
  }
  "$programs/gem_ensembles" rows "$plan" "$case" "$setting" "$base.h5" "$base.rows" "$base.map" 2>"$base.log" || {
    cat "$base.log" >&2
    return 1
  }
  [ "${GEM_KEEP:-0}" = 1 ] || rm -f "$base.h5"
  rm -f "$base.log"
  mv "$base.rows" "$base"
}

in_parallel "$jobs" "$out/list.txt" "$out/members" one_member

# joined HEADER FILE SUFFIX: all finished members, of other parts too, in the plan's order
joined() {
  {
    echo "$1"
    cut -f1 "$out/all.txt" | while IFS= read -r name; do
      [ ! -e "$out/members/$name" ] || cat "$out/members/$name$3"
    done
  } >"$2"
}
joined "case,setting,seed,moment_s,quantity,value" "$out/rows.csv" ""
joined "case,setting,seed,column,row,share" "$out/maps.csv" ".map"
"$programs/gem_ensembles" compare "$plan" "$out/rows.csv" "$out/maps.csv" "$out/ensembles.csv" "$out/map_means.csv"
echo "ensembles: $(find "$out/members" -name '*.map' | wc -l) of $(wc -l <"$out/all.txt") members are done"
cut -f1 "$out/list.txt" | while IFS= read -r name; do [ -e "$out/members/$name" ] || echo "$name"; done >"$out/unfinished.txt"
[ ! -s "$out/unfinished.txt" ] || exit 8

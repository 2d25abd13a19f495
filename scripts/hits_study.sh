#!/bin/sh
# Why engines log different numbers of hits on the platform: short runs of 004_400_50 (run 2 of Table 1, 450 m of drift), one
# setting turned at a time, and how often a floe touches the platform after so long without, from 300 s on.
# Usage: scripts/hits_study.sh PROGRAMS RUNS OUT.csv      then: scripts/speed_against_error.sh
#   PROGRAMS  folder with gem and gem_ensembles
#   RUNS      keeps the run files; what is there already is not run again
set -eu
[ $# -eq 3 ] || {
  sed -n '2,7s/^# //p' "$0" >&2
  exit 2
}
mkdir -p "$2"
programs=$(cd "$1" && pwd) runs=$(cd "$2" && pwd)
case $3 in /*) out=$3 ;; *) out=$PWD/$3 ;; esac
for program in gem gem_ensembles; do
  [ -x "$programs/$program" ] || {
    echo "no $programs/$program (not built) name the folder with gem and gem_ensembles" >&2
    exit 2
  }
done
cd "$(dirname "$0")/.."

# label | seeds | arguments of gem run
settings() {
  cat <<END
gem|1 2 3|--engine cpu
gem, a quarter of the moment|1|--engine cpu --set numerics.time_step_s=0.025
gem, 4 iterations|1|--engine cpu --set numerics.iterations_maximum=4
gem, 400 iterations|1|--engine cpu --set numerics.iterations_maximum=400
Box2D 8/3|1 2 3|--engine box2d
Box2D, skin 2.5 mm|1|--engine box2d --skin 0.0025
Box2D, nothing pushed apart|1|--engine box2d --position-iterations 0
Box2D, half the moment|1|--engine box2d --set numerics.time_step_s=0.05
Box2D, 4 substeps|1|--engine box2d --experiment substeps=4
Box2D, continuous|1|--engine box2d --experiment continuous=1
Box2D, cold starts|1|--engine box2d --experiment warm_starting=0
Box2D 20/10|1|--engine box2d --velocity-iterations 20 --position-iterations 10
Box2D 50/20|1 2|--engine box2d --velocity-iterations 50 --position-iterations 20
END
}

echo "setting,seed,slower_left_out_m_per_s,gap_s,per_s,commit" >"$out.part"
settings | while IFS='|' read -r label seeds arguments; do
  for seed in $seeds; do
    run=$runs/$(printf '%s' "$label" | tr -c 'a-zA-Z0-9\n' _).s$seed.h5
    [ -e "$run" ] || {
      # shellcheck disable=SC2086
      "$programs/gem" run cases/table1.toml --index 2 --until 900 --threads 1 --quiet --overwrite \
        --set output.event_speed_m_per_s=0 --set output.floes_interval_s=100 --set "run.seed=$seed" $arguments \
        --out "$run.part" </dev/null
      mv "$run.part" "$run"
    }
    # of the run, which may have been kept from an older program
    commit=$("$programs/gem" info --json "$run" | sed -n 's/.*"gem_build": "gem [^ ]* \([^ ]*\) .*/\1/p')
    [ -n "$commit" ] || {
      echo "no commit in $run (gem info --json) remove it, so that it is made again" >&2
      exit 1
    }
    "$programs/gem_ensembles" touches "$run" 300 900 0.15 0.3 1 3 10 >"$run.rows"
    while IFS= read -r row; do
      echo "\"$label\",$seed,$row,$commit"
    done <"$run.rows"
  done
done >>"$out.part"
mv "$out.part" "$out"

#!/bin/bash
# scripts/paper_runs.sh on several GPUs. Each GPU takes the next part that is free; while a part is collected, its GPU runs
# another. Needs bash, flock and tar. Run it again to continue after a stop: finished parts stay, others continue.
# Usage: scripts/paper_gpus.sh GEM OUT GPUS [PART...]
#   GEM   the program gem; gem_paper lies beside it
#   OUT   gets a folder for each part (seeds:1-3: seeds_1-3), as scripts/paper_runs.sh makes it; its file `done` says that it is
#         finished and by which program and settings: by others it is made again
#   GPUS  how many to use, of those in CUDA_VISIBLE_DEVICES if it is set
#   PART  of scripts/paper_runs.sh; left out: all, three seeds at a time
# Environment: GEM_JOBS=4 processes that collect a part;  GEM_RUN="--engine cuda" options of `gem sweep run`;  GEM_QUICK=1
#              GEM_ANY_COMMIT=1 also a program whose sources are in no commit, so that nobody can make the runs again
# For the page: each OUT/PART/summaries, packed by `tar -cJf bench/results/paper/PART.tar.xz PART/summaries`.
# Exit code: 0 all is done, 2 usage error, 8 some parts are not finished (OUT/PART.log says why): run it again.
set -euo pipefail
[ $# -ge 3 ] && [ "$3" -gt 0 ] 2>/dev/null || {
  sed -n '2,14s/^# //p' "$0" >&2
  exit 2
}
usage_error() {
  echo "$1" >&2
  exit 2
}
program=$(realpath "$1") gpus=$3
[ -x "$program" ] || usage_error "$1 is no program (no such file or not executable); name the program gem"
judge=$(dirname "$program")/gem_paper
[ -x "$judge" ] || usage_error "no $judge (not built); build gem_paper and put it beside $program"
made_by="$("$program" --version | head -n 1); ${GEM_RUN:=--engine cuda}; quick ${GEM_QUICK:-0}"
case ${GEM_ANY_COMMIT:-0}/$made_by in
0/*-dirty*) usage_error "$made_by (nobody can build that again); commit and build, or set GEM_ANY_COMMIT=1" ;;
esac
IFS=, read -ra devices <<<"${CUDA_VISIBLE_DEVICES:-$(seq -s, 0 $((gpus - 1)))}"
[ "${#devices[@]}" -ge "$gpus" ] || usage_error "$gpus GPUs are asked for (CUDA_VISIBLE_DEVICES names ${#devices[@]}); ask for fewer"
mkdir -p "$2"
out=$(realpath "$2")
exec 9>"$out/lock"
flock -n 9 || usage_error "$out is in use (by another call of this script); wait for it or choose another folder"
shift 3
[ $# -gt 0 ] || set -- day:1 day:2 day:3 table2 period_question sensitivity sensitivity_moment divergence seeds:1-3 seeds:4-6 \
  seeds:7-9 seeds:10-12 seeds:13-15 seeds:16-18 seeds:19-21 seeds:22-24 seeds:25-27 seeds:28-30
parts=("$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export GEM_RUN GEM_JOBS=${GEM_JOBS:-4}
rm -rf "$out/taken"
mkdir -p "$out/taken"
# Each lane is a group of processes of its own, so that its runs end with it, in order.
set -m
end_lanes() {
  local lane
  for lane in $(jobs -p); do kill -- "-$lane" 2>/dev/null || true; done
  wait
}
trap end_lanes EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

note() { echo "$(date -u +%H:%M:%S) $*" | tee -a "$out/log"; }

# The program on one GPU: of all that run at the same time, one has it.
for ((gpu = 0; gpu < gpus; ++gpu)); do
  mkdir -p "$out/gpu/$gpu"
  cat >"$out/gpu/$gpu/gem" <<END
#!/bin/bash
export CUDA_VISIBLE_DEVICES=${devices[gpu]}
[ "\$1 \$2" != "sweep run" ] || exec flock "$out/gpu/$gpu/lock" "$program" "\$@"
exec "$program" "\$@"
END
  chmod +x "$out/gpu/$gpu/gem"
  ln -sf "$judge" "$out/gpu/$gpu/gem_paper"
done

is_done() { [ "$(cat "$out/$1/done" 2>/dev/null)" = "$made_by" ]; }

# lane GPU: takes parts one after another
lane() {
  local part name status
  for part in "${parts[@]}"; do
    name=${part/:/_}
    ! is_done "$name" && mkdir "$out/taken/$name" 2>/dev/null || continue
    [ ! -e "$out/$name/done" ] || rm -rf "${out:?}/$name"
    note "GPU $1 begins $part"
    status=0
    sh scripts/paper_runs.sh "$out/gpu/$1/gem" "$out/$name" "$part" >"$out/$name.log" 2>&1 || status=$?
    [ $status -ne 0 ] || echo "$made_by" >"$out/$name/done"
    note "GPU $1 ends $part ($status)"
  done
}

# two for each, those that come first on a GPU each
for ((turn = 0; turn < 2 * gpus; ++turn)); do
  lane $((turn % gpus)) 9>&- &
  sleep 0.2
done
wait
for part in "${parts[@]}"; do
  is_done "${part/:/_}" || exit 8
done

#!/bin/bash
# scripts/paper_runs.sh on several GPUs: each takes the next part that nobody has begun, and while one part is collected its GPU
# runs another. Needs bash, flock and tar; run it again to go on after a stop: finished parts stay, others go on.
# Usage: scripts/paper_gpus.sh GEM OUT GPUS [PART...]
#   GEM   the program
#   OUT   gets a folder for each part, as scripts/paper_runs.sh makes it; OUT/PART/done marks those that are finished
#   GPUS  how many of the machine to use
#   PART  of scripts/paper_runs.sh; left out: all, three seeds at a time
# Environment: GEM_JOBS=4 processes that collect a part;  GEM_RUN="--engine cuda" options of `gem sweep run`;  GEM_QUICK=1
# For the page: each OUT/PART/summaries, packed by `tar -cJf bench/results/paper/PART.tar.xz PART/summaries`.
# Exit code: 0 all is done, 2 wrong use, 8 something is left (OUT/PART.log says why): run it again.
set -euo pipefail
[ $# -ge 3 ] && [ "$3" -gt 0 ] 2>/dev/null || {
  sed -n '2,12s/^# //p' "$0" >&2
  exit 2
}
program=$(realpath "$1") gpus=$3
mkdir -p "$2"
out=$(realpath "$2")
shift 3
[ $# -gt 0 ] || set -- day:1 day:2 day:3 table2 period_question sensitivity sensitivity_moment divergence seeds:1-3 seeds:4-6 \
  seeds:7-9 seeds:10-12 seeds:13-15 seeds:16-18 seeds:19-21 seeds:22-24 seeds:25-27 seeds:28-30
parts=("$@")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export GEM_RUN=${GEM_RUN:---engine cuda} GEM_JOBS=${GEM_JOBS:-4}
rm -rf "$out/taken"
mkdir -p "$out/taken"

note() { echo "$(date -u +%H:%M:%S) $*" | tee -a "$out/log"; }

# The program on one GPU: of all that run at the same time, one has it.
for ((gpu = 0; gpu < gpus; ++gpu)); do
  mkdir -p "$out/gpu/$gpu"
  cat >"$out/gpu/$gpu/gem" <<END
#!/bin/bash
export CUDA_VISIBLE_DEVICES=$gpu
[ "\$1 \$2" != "sweep run" ] || exec flock "$out/gpu/$gpu/lock" "$program" "\$@"
exec "$program" "\$@"
END
  chmod +x "$out/gpu/$gpu/gem"
done

# takes PARTS one after another for a GPU
lane() {
  local part name status
  for part in "${parts[@]}"; do
    name=${part/:/_}
    [ ! -e "$out/$name/done" ] && mkdir "$out/taken/$name" 2>/dev/null || continue
    note "GPU $1 begins $part"
    status=0
    sh scripts/paper_runs.sh "$out/gpu/$1/gem" "$out/$name" "$part" >"$out/$name.log" 2>&1 || status=$?
    [ $status -ne 0 ] || touch "$out/$name/done"
    note "GPU $1 ends $part ($status)"
  done
}

# two for each, those that come first on a GPU each
for ((turn = 0; turn < 2 * gpus; ++turn)); do
  lane $((turn % gpus)) &
  sleep 0.2
done
wait
for part in "${parts[@]}"; do
  [ -e "$out/${part/:/_}/done" ] || exit 8
done

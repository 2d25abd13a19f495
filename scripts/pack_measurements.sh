#!/usr/bin/env bash
# Builds the measuring programs as single files and packs them with their cases and settings for a machine without these
# packages: unpack there and run `scripts/measure_all.sh bin OUT PROCESSORS SECONDS`, or parts by `sh scripts/measure.sh bin OUT JOBS`.
# Usage: scripts/pack_measurements.sh BOX2D_SOURCES OUT.tar.xz [CMAKE_OPTION...]
#   BOX2D_SOURCES  the folder that scripts/box2d_source.sh prints
# Environment: GEM_CUDA_PROGRAM=FILE a static gem with CUDA, packed as gem_cuda for scripts/scatter_gpu.sh
#              GEM_SLOP=0 without gem_slop
set -euo pipefail
[ $# -ge 2 ] || {
  sed -n '2,7s/^# //p' "$0" >&2
  exit 2
}
sources=$(cd "$1" && pwd) out=$(realpath -m "$2")
shift 2
cd "$(dirname "${BASH_SOURCE[0]}")/.."
programs=(gem gem_ensembles window_errors closed_form_errors paired_speed gem_hard_tests)

# The tests run in the unpacked folder.
cmake --preset portable -DGEM_BOX2D_SOURCE="$sources" -DGEM_TEST_ROOT=. "$@" --log-level=WARNING
cmake --build --preset portable --target gem_measurements gem_hard_tests
# The same program with Box2D's slop at 1 mm, for one experiment.
if [ "${GEM_SLOP:-1}" = 1 ]; then
  cmake --preset portable -B build-portable-slop -DGEM_BOX2D_SOURCE="$sources" -DGEM_BOX2D_SLOP=0.001 -DGEM_TESTS=OFF "$@" \
    --log-level=WARNING
  cmake --build build-portable-slop --target gem
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/measure/bin"
for program in "${programs[@]}"; do
  scripts/check_portable.sh "build-portable/$program"
  cp "build-portable/$program" "$work/measure/bin/"
done
[ "${GEM_SLOP:-1}" = 0 ] || cp build-portable-slop/gem "$work/measure/bin/gem_slop"
[ -z "${GEM_CUDA_PROGRAM:-}" ] || cp "$GEM_CUDA_PROGRAM" "$work/measure/bin/gem_cuda"
strip "$work"/measure/bin/*
cp -r --parents cases bench/*_settings.txt bench/speed_pairs.txt validation/baseline/{ensembles.txt,table1_5cm.toml} validation/hard/known_misses.txt \
  scripts/measure.sh scripts/measure_all.sh scripts/ensembles.sh scripts/workers.sh scripts/scatter_gpu.sh scripts/studies "$work/measure"
find "$work" -name __pycache__ -prune -exec rm -r {} +
XZ_OPT="-6 --lzma2=dict=128MiB" tar -C "$work" -caf "$out" measure # as its suffix says; xz finds what the programs share
echo "$out: $(du -h "$out" | cut -f1); there: tar xf, cd measure, scripts/measure_all.sh bin out PROCESSORS SECONDS"

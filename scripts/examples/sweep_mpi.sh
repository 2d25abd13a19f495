#!/usr/bin/env bash
# A sweep over the ranks of mpirun. Every rank gets the whole sweep and takes runs that no other rank has taken, so long and
# short runs balance by themselves. gem itself does not use MPI.
# Usage: sweep_mpi.sh RANKS SWEEP.toml DIR    (gem on the PATH, or GEM=path/to/gem)
set -euo pipefail
mpirun -n "$1" "${GEM:-gem}" sweep run "$2" --out "$3" --jobs 1 --threads 1 --progress none
"${GEM:-gem}" sweep status "$3"

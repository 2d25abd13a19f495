#!/usr/bin/env bash
# A sweep as a Slurm array with one task per run. The range of the array is the range of runs (`gem sweep list`):
#   sbatch --array=1-36 scripts/examples/sweep_slurm.sh cases/table1.toml runs/table1
# Submit again to redo tasks that were cut off; done runs end at once. GEM=path/to/gem if gem is not on the PATH.
#SBATCH --job-name=gem-sweep
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --output=gem-sweep-%A_%a.log
set -euo pipefail
exec "${GEM:-gem}" sweep run "$1" --out "$2" --index "$SLURM_ARRAY_TASK_ID" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" --progress json

#!/usr/bin/env bash
# A suite as a Slurm job array: each task does one shard, and goes on where it was when Slurm
# requeues it; what Slurm gives up goes on when the same array is submitted again. From the
# project's root, after a build:
#
#   sbatch --array=1-4 benchmarks/slurm_array.sh SUITE.yaml OUT
#   ./regoplan benchmark merge OUT/shard-* --out OUT/whole     # when all tasks have ended
#
# A task that Slurm holds ("launch failed requeued held", after a node came back) goes on with
# `scontrol release JOB`.
#
# The folder OUT must be seen by every node. REGOPLAN names the program where it is not ./regoplan.
#SBATCH --job-name=regoplan
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
if (($# != 2)); then
  echo "usage: sbatch --array=1-N $0 SUITE.yaml OUT" >&2
  exit 1
fi
shard=$SLURM_ARRAY_TASK_ID
exec "${REGOPLAN:-./regoplan}" benchmark "$1" --quiet --out "$2/shard-$shard" \
  --shard "$shard/$SLURM_ARRAY_TASK_COUNT" --processes "${SLURM_CPUS_PER_TASK:-1}"

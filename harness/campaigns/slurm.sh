#!/bin/bash
#SBATCH --job-name=ddem-nightly
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
# A campaign as an array of shards: sbatch --array=1-8 slurm.sh [CAMPAIGN.toml]
# DDEM: the program (default: ddem); NIGHT: the folder that shards and report go to (default: night-JOB).
# A shard that is started again goes on where it was; whichever finds all shards done merges and judges them.
set -euo pipefail

ddem=${DDEM:-ddem}
night=${NIGHT:-night-$SLURM_ARRAY_JOB_ID}
shard=$SLURM_ARRAY_TASK_ID
shards=$SLURM_ARRAY_TASK_COUNT

mkdir -p -- "$night"
status=0
"$ddem" validate "$@" --shard "$shard/$shards" --resume -j "${SLURM_CPUS_PER_TASK:-1}" -o "$night/shard-$shard" || status=$?
if ((status > 1)); then exit "$status"; fi  # 1: a unit failed, which the report says
touch -- "$night/shard-$shard/done"

exec 9>"$night/.merging"
flock 9
if [[ $(find "$night" -mindepth 2 -maxdepth 2 -path '*/shard-*/done' | wc -l) == "$shards" && ! -e $night/merged ]]; then
  touch -- "$night/merged"
  exec "$ddem" merge "$night"/shard-* -o "$night/report"
fi

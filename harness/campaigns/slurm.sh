#!/bin/bash
#SBATCH --job-name=ddem-nightly
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
# A campaign as an array of shards: sbatch --array=1-8 slurm.sh [CAMPAIGN.toml]
# DDEM: the program (default: ddem); NIGHT: the folder that shards and report go to (default: night-JOB).
# Whichever task finds all shards done merges and judges them, and its exit code is the campaign's. Whatever went wrong (a
# shard, the merge, the disk, the time limit), start any task again, alone or all of them, with the same NIGHT and campaign:
# what is done is kept, and what was not merged since it was done is merged.
set -euo pipefail

: "${SLURM_ARRAY_TASK_ID:?start it as an array: sbatch --array=1-8 slurm.sh [CAMPAIGN.toml]}"
ddem=${DDEM:-ddem}
night=${NIGHT:-night-$SLURM_ARRAY_JOB_ID}
shard=$SLURM_ARRAY_TASK_ID

mkdir -p -- "$night"
exec 9>"$night/.lock-of-tasks" # one at a time from flock to its end; the system frees it of a task that dies
flock 9
# The night is cut once: an array of one task that was started again has a count of its own.
[[ -s $night/shards ]] || echo "$SLURM_ARRAY_TASK_COUNT" >"$night/shards"
shards=$(<"$night/shards")
flock -u 9
if [[ ! $shards =~ ^[1-9][0-9]*$ ]]; then
  echo "$night/shards: holds no number of tasks; remove it, or set NIGHT to another folder" >&2
  exit 2
fi
if ((shard > shards)); then
  echo "$night was begun with --array=1-$shards: task $shard is none of it; set NIGHT to another folder" >&2
  exit 2
fi

status=0
"$ddem" validate "$@" --shard "$shard/$shards" --resume -j "${SLURM_CPUS_PER_TASK:-1}" -o "$night/shard-$shard" 9>&- || status=$?
if ((status > 1)); then exit "$status"; fi # 1: a unit failed, which the report says
touch -- "$night/shard-$shard/done"

flock 9
folders=()
for ((i = 1; i <= shards; ++i)); do
  if [[ ! -e $night/shard-$i/done ]]; then exit 0; fi
  folders+=("$night/shard-$i")
done
# Of the merge before: not older than any shard.
if [[ -e $night/merged && -z $(find "${folders[@]}" -maxdepth 1 -name done -newer "$night/merged") ]]; then exit 0; fi
touch -- "$night/merging"
status=0
"$ddem" merge "${folders[@]}" -o "$night/report" || status=$? # keeps the lock until its end, even without us
if ((status > 1)); then exit "$status"; fi
mv -- "$night/merging" "$night/merged"
exit "$status"

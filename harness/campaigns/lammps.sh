#!/bin/bash
#SBATCH --job-name=ddem-lammps
#SBATCH --ntasks=16
#SBATCH --cpus-per-task=1
# A scene by DDEM on LAMMPS, on all ranks of the job: sbatch --ntasks=64 lammps.sh SCENE.toml [OPTIONS of ddem run]
# DDEM: the program (default: ddem). It starts ddem-lammps by srun, and measures what comes back.
set -euo pipefail
: "${SLURM_NTASKS:?start it by sbatch --ntasks=N lammps.sh SCENE.toml}"
exec "${DDEM:-ddem}" run "$@" --solver lammps-ddem --ranks "$SLURM_NTASKS"

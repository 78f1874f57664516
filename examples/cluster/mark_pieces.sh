#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A job for Slurm: marks a mesh in pieces on many processors. docs/scale.md says how to build riis with MPI.
#   sbatch mark_pieces.sh heart.pvtu marked.pvtu
#SBATCH --job-name=riis-mark
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=32
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=00:30:00
set -euo pipefail

mesh=${1:?the first argument is the mesh, a .pvtu file}
output=${2:?the second argument is the output, a .pvtu file}
shift 2

# Each rank has one processor, so it gets one thread. Further arguments go to riis, such as --valve mitral --opening 0.3.
srun "${RIIS:-riis}" mark "$mesh" --threads "${SLURM_CPUS_PER_TASK:-1}" --output "$output" "$@"

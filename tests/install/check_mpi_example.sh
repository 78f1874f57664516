#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_mpi_example.sh EXAMPLES_BUILD_DIR N_RANKS [Fortran]
# Runs the examples of MPI where check_install.sh built them. The programs compare the marks and labels of the ranks with those of
# the whole mesh.
# Environment: MPIEXEC
set -euo pipefail
build=$1 n_ranks=$2
shift 2

# Settings for Open MPI. Other MPI libraries ignore them. The test must run on any single machine, however small or restricted:
#   with more ranks than processors, where waiting ranks yield
#   as root
#   without ssh, since no rank is started elsewhere
#   without a network except the loopback
#   in a container that forbids copying from one process's memory to another's
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_plm=isolated OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
# In Open MPI 5, the launcher is PRRTE, whose settings have other names.
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none

suffixes=("")
[[ " $* " != *" Fortran "* ]] || suffixes+=(_fortran)

check() { # arguments: example, and the lines that it must print
  local example=$1 suffix program printed
  shift
  for suffix in "${suffixes[@]}"; do
    program=$build/$example$suffix
    printed=$("$MPIEXEC" -n "$n_ranks" "$program" </dev/null) ||
      { echo "problem: $program failed; it printed: $printed" >&2; exit 1; }
    diff <(printf '%s\n' "$@") <(printf '%s\n' "$printed") ||
      { echo "problem: $program does not print what it should" >&2; exit 1; }
  done
}

check mpi_partition "19683 nodes, marked: 823" "$n_ranks ranks, marked: 823, the same nodes and distances"
check mpi_leaks "19683 nodes, 2 open regions: the valve seals" "$n_ranks ranks: the same labels"
if [[ " $* " == *" Fortran "* ]]; then
  suffixes=("")
  check mpi_fixed_form "step 1, marked nodes: 818" "step 2, marked nodes: 791" "step 3, marked nodes: 776" \
    "$n_ranks ranks: the same sums as the whole grid"
fi

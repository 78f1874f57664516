# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run fenicsx, which reads this file: install dolfinx and the Python package, run the example, check, draw. The
# steps use $packages, install_missing, is_on_offer, version_on_offer, say and step of `run`.

# Debian's reference BLAS makes the solver of the linear systems ten times slower than OpenBLAS.
fenicsx_packages=(gcc g++ cmake ninja-build libembree-dev libtbb-dev nlohmann-json3-dev python3 python3-dev python3-venv
  python3-dolfinx python3-gmsh python3-numpy python3-matplotlib openmpi-bin libopenblas0-pthread)
fenicsx_version=0.9 # the one of Debian 13

# ./run fenicsx
#   Opens a mechanical valve in a duct with dolfinx 0.9, in Python. The command compares marks on 1 and 2 ranks, compares the drop
#   across the closed valve with the exact formula, and leaves a picture in out/fenicsx. The command builds the Python package for
#   the distribution's Python, with build tools from PyPI. The command is skipped if the distribution lacks dolfinx 0.9, as Debian
#   12 does.
run_fenicsx() {
  local here=$PWD/examples/fenicsx work=$PWD/build-python/fenicsx out=$PWD/out/fenicsx python fenicsx_log
  (($# == 0)) || { echo "./run fenicsx: '$*' is not an argument of this command" >&2; exit 2; }
  fenicsx_is_there || return 0
  packages=("${fenicsx_packages[@]}")
  install_missing
  step "install the Python package beside the distribution's dolfinx" fenicsx_environment "$work"
  python=$work/venv/bin/python
  mkdir -p "$out"
  fenicsx_log=$work/output.txt
  fenicsx_settings
  step "bad input" fenicsx_in "$work" "$python" -B "$here/check.py" refusals
  cat "$fenicsx_log"
  step "the valve opens, on 2 ranks" fenicsx_in "$out" mpirun -n 2 "$python" -B -m mpi4py "$here/valve_in_duct.py"
  grep ' s, opening' "$fenicsx_log"
  step "the same on 1 rank, recorded" fenicsx_in "$work" "$python" -B "$here/check.py" record "$work" 10
  step "and half of it on 2 ranks" fenicsx_in "$work" mpirun -n 2 "$python" -B -m mpi4py "$here/check.py" record "$work" 5
  "$python" -B "$here/check.py" marks "$work" 2 | tee "$out/marks.txt"
  step "the drop across the closed valve" fenicsx_in "$work" "$python" -B "$here/check.py" drops
  tee "$out/drops.txt" <"$fenicsx_log"
  step "the force on a valve that opens" fenicsx_in "$work" "$python" -B "$here/check.py" forces
  tee "$out/forces.txt" <"$fenicsx_log"
  step "draw" fenicsx_in "$work" "$python" -B "$here/check.py" picture "$work" "$out/velocity.png"
  say "wrote out/fenicsx/velocity.png, marks.txt, drops.txt and forces.txt; for ParaView out/fenicsx/flow.bp"
}

# If the distribution lacks dolfinx, or has another version, prints why nothing runs.
fenicsx_is_there() {
  local version
  is_on_offer python3-dolfinx || true
  version=$(version_on_offer python3-dolfinx)
  [[ $version != "$fenicsx_version".* ]] || return 0
  say "skipped: the example is for dolfinx $fenicsx_version, as in Debian 13; this distribution has ${version:-none}"
  return 1
}

# fenicsx_environment FOLDER: makes FOLDER/venv with the distribution's Python, which has dolfinx, and builds the package there.
fenicsx_environment() {
  local venv=$1/venv
  mkdir -p "$1"
  rm -rf "$venv"
  /usr/bin/python3 -m venv --system-site-packages "$venv" && "$venv/bin/pip" install --no-deps .
}

# By default, Open MPI refuses to run as root and with more ranks than processors. Each rank has one thread.
fenicsx_settings() {
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl=self,sm
  export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
  export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
}

# fenicsx_in FOLDER COMMAND...: runs the command in the folder. The output of COMMAND is also in $fenicsx_log.
fenicsx_in() {
  cd "$1" || return
  shift
  "$@" 2>&1 | tee "$fenicsx_log"
}

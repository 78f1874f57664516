# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run code_saturne, which reads this file, and of the test example_code_saturne. The study of code_saturne has
# three cases. The cases c and fortran are named after the languages, and reference has the solver's own head-loss zone. Each run
# has a name.

# saturne_environment WORK PREFIX: prepares for runs in the folder WORK, with riis installed in PREFIX.
saturne_environment() {
  saturne_work=$(cd -- "$1" && pwd)
  saturne_source=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
  RIIS_PREFIX=$(cd -- "$2" && pwd)
  export RIIS_PREFIX
  # code_saturne's script stops if this variable is missing, as in containers.
  export USER=${USER:-$(id -un)}
  # By default, Open MPI refuses to run as root and with more ranks than processors. Each rank has one thread.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
  export OMPI_MCA_plm=isolated OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
}

# saturne_mesh: makes the mesh of the root. One thread makes the same mesh on every machine.
saturne_mesh() {
  gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -format msh22 -o "$saturne_work/root.msh" "$saturne_source/root.geo"
}

# saturne_make_study: makes the study with its mesh and the user files of each case.
saturne_make_study() {
  local case
  rm -rf "$saturne_work/STUDY"
  (cd "$saturne_work" && code_saturne create -s STUDY -c c -c fortran -c reference) || return
  cp "$saturne_work/root.msh" "$saturne_work/STUDY/MESH" || return
  for case in c fortran reference; do
    cp "$saturne_source"/common/*.{c,h,f90} "$saturne_source/$case"/cs_user_* "$saturne_work/STUDY/$case/SRC" &&
      cp "$saturne_source/common/cs_user_scripts.py" "$saturne_work/STUDY/$case/DATA" || return
  done
}

# saturne_run CASE NAME RANKS [VARIABLE=VALUE...]: runs a case; settings.c lists the variables. The results are in
# STUDY/CASE/RESU/NAME.
saturne_run() {
  local case=$1 name=$2 ranks=$3
  shift 3
  rm -rf "$saturne_work/STUDY/$case/RESU/$name"
  (cd "$saturne_work/STUDY/$case/DATA" && env "$@" timeout "${saturne_limit:-1800}" code_saturne run -n "$ranks" --id "$name")
}

# saturne_closed STEPS FORTRAN_STEPS RANKS...: runs the closed valve in a flow of 5 cm/s, in C and in Fortran, with each number of
# ranks. Also runs the solver's own head-loss zone, with the same cells and the same K.
saturne_closed() {
  local ranks steps=$1 fortran_steps=$2 cells=$saturne_work/STUDY/c/RESU/closed_1
  shift 2
  for ranks in "$@"; do
    saturne_run c "closed_$ranks" "$ranks" VALVE_OPENING=0 RUN_INFLOW=0.05 RUN_STEPS="$steps" RUN_CELLS_EVERY="$steps" &&
      saturne_run fortran "closed_$ranks" "$ranks" VALVE_OPENING=0 RUN_INFLOW=0.05 RUN_STEPS="$fortran_steps" \
        RUN_CELLS_EVERY="$steps" || return
  done
  cat "$cells"/cells_*.csv >"$saturne_work/cells.csv" &&
    saturne_run reference closed 1 REFERENCE_CELLS="$saturne_work/cells.csv" RUN_INFLOW=0.05 RUN_STEPS="$steps"
}

# saturne_open: runs the open valve in a flow of 20 cm/s, and then the same flow without a valve.
saturne_open() {
  saturne_run c open 1 VALVE_OPENING=1 RUN_INFLOW=0.2 RUN_STEPS=25 &&
    saturne_run c none 1 VALVE_PRESENT=0 RUN_INFLOW=0.2 RUN_STEPS=25
}

# saturne_beat: runs the beat, in which the solver's pressures open and close the valve. Further runs leave out u_surface, use
# several ranks until the valve is open, or restart halfway. Both halves of the beat, up to the restart and after it, are also run
# without a valve.
saturne_beat() {
  local half=30 steps=45
  saturne_run c beat 1 RUN_STEPS=150 RUN_SLICE_EVERY=5 RUN_CHECKPOINT=$half &&
    saturne_run fortran beat 1 RUN_STEPS=150 &&
    saturne_run c beat_still 1 RUN_STEPS=150 VALVE_VELOCITY=0 &&
    saturne_run c beat_2 2 RUN_STEPS=$steps &&
    saturne_run c beat_4 4 RUN_STEPS=$steps &&
    saturne_run fortran beat_2 2 RUN_STEPS=$steps &&
    saturne_run c half 1 RUN_STEPS=$half &&
    saturne_run c continued 1 RUN_STEPS=$steps RUN_RESTART="$saturne_work"/STUDY/c/RESU/half/checkpoint &&
    saturne_run fortran half 1 RUN_STEPS=$half &&
    saturne_run fortran continued 1 RUN_STEPS=$steps RUN_RESTART="$saturne_work"/STUDY/fortran/RESU/half/checkpoint &&
    saturne_run c none_whole 1 RUN_STEPS=$steps VALVE_PRESENT=0 &&
    saturne_run c none_half 1 RUN_STEPS=$half VALVE_PRESENT=0 &&
    saturne_run c none_continued 1 RUN_STEPS=$steps VALVE_PRESENT=0 RUN_RESTART="$saturne_work"/STUDY/c/RESU/none_half/checkpoint
}

# Packages that ./run code_saturne needs, without recommended packages. Debian 13 lacks the first two.
saturne_packages=(code-saturne code-saturne-include gmsh openmpi-bin libopenmpi-dev python3-numpy python3-matplotlib)
saturne_build_packages=(gcc g++ gfortran cmake ninja-build pkg-config libembree-dev libtbb-dev)

# saturne_is_there: returns whether code_saturne is installed or available as a package of this distribution.
saturne_is_there() {
  command -v code_saturne >/dev/null || [[ $(version_on_offer code-saturne) ]]
}

# saturne_install_riis FOLDER: builds the library with its Fortran modules, and installs it into FOLDER/prefix.
saturne_install_riis() {
  cmake -S . -B "$1/riis" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX="$PWD/$1/prefix" -D RIIS_WITH_VTK=OFF \
    -D RIIS_WITH_FORTRAN=ON -D RIIS_BUILD_PROGRAM=OFF -D RIIS_BUILD_TESTS=OFF -D RIIS_BUILD_BENCH=OFF &&
    cmake --build "$1/riis" --parallel "$(nproc)" && cmake --install "$1/riis"
}

# ./run code_saturne [--short]
#   Runs the valve in code_saturne 6.0, in C and in Fortran. The valve is closed, open, or moves through a beat that the solver's
#   own pressures drive. The command compares the valve with the solver's own head losses, and compares 1, 2 and 4 ranks. The
#   command leaves tables and pictures in out/code_saturne, in a quarter of an hour. --short runs only the closed valve, on 1 and
#   2 ranks, in two minutes. The command is skipped if the distribution lacks code_saturne, as Debian 13 does.
#
# The command uses $build, $packages, install_missing, version_on_offer, say and step
# of `run`.
run_code_saturne() {
  local folder=$build/code_saturne parts=(closed open beat) python
  case $* in
    '') ;;
    --short) parts=(closed) ;;
    *)
      echo "./run code_saturne: '$*' is not an option" >&2
      exit 2
      ;;
  esac
  packages=("${saturne_build_packages[@]}")
  install_missing
  if ! saturne_is_there; then
    say "skipped: this distribution has no package code-saturne; Debian 12 has it"
    return
  fi
  install_missing "${saturne_packages[@]}"
  python=$(python_of_packages)
  mkdir -p "$folder" out/code_saturne
  step "build riis and install it into $folder/prefix" saturne_install_riis "$folder"
  saturne_environment "$folder" "$folder/prefix"
  step "mesh the aortic root" saturne_mesh
  step "make the study" saturne_make_study
  if [[ ${1:-} == --short ]]; then
    step "closed valve: C and Fortran on 1 and 2 ranks, the solver's own zone" saturne_closed 10 20 1 2
  else
    step "closed valve: C and Fortran on 1, 2 and 4 ranks, the solver's own zone" saturne_closed 20 60 1 2 4
    step "open valve, and no valve" saturne_open
    step "a beat on 1, 2 and 4 ranks, after a restart, and without a valve (the longest step)" saturne_beat
  fi
  "$python" -B examples/code_saturne/check.py "$folder/STUDY" "${parts[@]}" --out out/code_saturne |
    tee out/code_saturne/checks.md
  say "wrote the tables, out/code_saturne/checks.md, and out/code_saturne/*.png"
}

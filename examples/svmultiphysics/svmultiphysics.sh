# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run svmultiphysics. `run` sources this file. The steps use $build, $n_jobs, $packages, install_missing,
# python_of_packages, say and step of `run`.

svmultiphysics_packages=(g++ cmake ninja-build libembree-dev libtbb-dev libvtk9-dev libopenmpi-dev openmpi-bin libblas-dev
  liblapack-dev gmsh python3-scipy python3-matplotlib)
svmultiphysics_here=$PWD/examples/svmultiphysics

# ./run svmultiphysics FOLDER
#   Makes riis the valve engine of the svMultiPhysics in FOLDER, whose files stay as they are, and compares both engines: signs,
#   K, the steps in which a valve turns, two ranks, a restart, the drop of a closed valve, and the time. FOLDER holds the folder
#   Code of github.com/SimVascular/svMultiPhysics, commit b5fbed0. The command compiles in build/svmultiphysics and leaves tables
#   and a picture in out/svmultiphysics. Without a FOLDER that holds Code/Source/solver/uris.cpp, the status is 77.
run_svmultiphysics() {
  local solver=${1-} out=$PWD/out/svmultiphysics
  (($# <= 1)) || refuse "'$*' must be one folder"
  if [[ ! -e $solver/Code/Source/solver/uris.cpp ]]; then
    say "skipped: ./run svmultiphysics FOLDER needs the sources of svMultiPhysics, commit b5fbed0, in FOLDER: FOLDER/Code"
    say "git clone https://github.com/SimVascular/svMultiPhysics FOLDER && git -C FOLDER checkout b5fbed0"
    exit 77
  fi
  sv_code=$(realpath -- "$solver")/Code
  packages=("${svmultiphysics_packages[@]}")
  install_missing
  python=$(python_of_packages)
  sv_work=$PWD/$build/svmultiphysics
  sv_runs=$sv_work/runs
  mkdir -p "$sv_work" "$out"
  rm -rf "$sv_runs" "${out:?}"/*
  mkdir -p "$sv_runs"
  sv_check() { "$python" -B "$svmultiphysics_here/check.py" "$@"; }

  step "build the library and the program riis" sv_library
  step "build svMultiPhysics as it is (the longest step)" sv_plain
  step "make riis its valve engine" sv_engine
  step "make the meshes and export the valves" sv_cases
  sv_settings
  step "the closed valve with both engines" sv_closed
  sv_check drop "$sv_runs"/closed{,_solver} "$(sv_area closed)" | tee "$out/drop.txt"
  step "a beat with a ramp and a scaffold, with three engines" sv_beats
  sv_check switching "$sv_runs"/beat{,_solver,_distances} | tee "$out/switching.txt"
  sv_check cost "$sv_runs"/beat{,_solver} | tee "$out/cost.txt"
  step "the same valve without ramp and scaffold, with three engines" sv_plain_beats
  sv_check switching "$sv_runs"/plain{,_solver,_distances} | tee -a "$out/switching.txt"
  step "two ranks" sv_ranks
  sv_check ranks "$sv_runs"/short{,_2} | tee "$out/ranks.txt"
  step "a run that continues while the valve opens, with both engines" sv_restart
  sv_check restart "$sv_runs"/{beat,continued,continued_solver} | tee "$out/restart.txt"
  step "Taylor-Hood elements" sv_run th th riis 1 signs
  step "a valve that moves in an elastic tube" sv_run fsi fsi riis 1 all
  step "two valves, one of them scaled" sv_run two two riis 1 all
  sv_check signs "$sv_runs"/{beat,short_2,th,fsi,two} | tee "$out/signs.txt"
  sv_check points "$sv_runs"/{short,short_2,th,fsi,two,continued} | tee "$out/points.txt"
  sv_check draw "$sv_runs"/beat{,_solver,_distances} "$out/beat.png"
  step "take the engine out again, which gives the program of before" sv_undo
  say "wrote out/svmultiphysics/*.txt and out/svmultiphysics/beat.png"
}

sv_library() {
  cmake --preset library -G Ninja -B "$sv_work/library" -D CMAKE_INSTALL_PREFIX="$sv_work/riis" &&
    cmake --build "$sv_work/library" --parallel "$n_jobs" &&
    cmake --install "$sv_work/library" &&
    cmake --preset default &&
    cmake --build --preset default --parallel "$n_jobs" --target riis_program
}

# sv_compile OPTION...: configures and compiles the solver. A solver that is up to date costs seconds.
sv_compile() {
  cmake -G Ninja -S "$sv_code" -B "$sv_work/solver" -D CMAKE_BUILD_TYPE=Release \
    -D CMAKE_MODULE_PATH="$svmultiphysics_here/find" "$@" &&
    cmake --build "$sv_work/solver" --parallel "$n_jobs" --target svmultiphysics
}

sv_program() { find "$sv_work/solver" -type f -name svmultiphysics -perm -u+x; }

sv_plain() {
  sv_compile -U CMAKE_PROJECT_SV_INCLUDE && sha256sum "$(sv_program)" >"$sv_work/plain.sha256"
}

sv_engine() {
  sv_compile -D CMAKE_PROJECT_SV_INCLUDE="$svmultiphysics_here/riis.cmake" -D riis_DIR="$sv_work/riis/lib/cmake/riis" \
    -D RIIS_URIS_CHECK=ON
}

sv_undo() {
  sv_compile -U CMAKE_PROJECT_SV_INCLUDE && sha256sum --check "$sv_work/plain.sha256"
}

# There may be more ranks than processors, and the user may be root. The settings in the second line are for Open MPI 4, and the
# settings in the third line for Open MPI 5.
sv_settings() {
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none
  export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
}

# ---- Cases ----

# sv_mesh NAME KIND EDGE: a tube of gmsh, or an elastic one with a wall.
sv_mesh() {
  "$python" -B "$svmultiphysics_here/cases.py" "$2" "$3" "$1.geo" && gmsh -3 -format msh2 -o "$1.msh" "$1.geo"
}

# sv_export NAME MESH SECONDS [OPTION...]: exports a trileaflet valve to NAME and NAME.xml. It moves in SECONDS.
sv_export() {
  local name=$1 mesh=$2 seconds=$3
  shift 3
  rm -rf "$name"
  RIIS_PYTHON=${RIIS_PYTHON-$python} "$OLDPWD/$build/bin/riis" export "$name" "$mesh.msh" --unit cm --valve trileaflet \
    --half-thickness 0.2 --resistance 1e3 --time-step 0.004 --opening-seconds "$seconds" --closing-seconds "$seconds" \
    --largest-edge 0.2 "$@" >"$name.xml"
}

# The exports and the cases. Paths in the blocks of an export are relative to $sv_work.
sv_cases() {
  cd "$sv_work" || return
  local write=("$python" -B "$svmultiphysics_here/cases.py")
  sv_mesh tube tube 0.22 && sv_mesh long tube 0.26 && sv_mesh elastic elastic 0.26 && sv_mesh fine tube 0.192 || return
  "${write[@]}" scaffold ring.vtu || return
  sv_export plain tube 0.02 && sv_export closed fine 0.02 --largest-edge 0.1 || return
  # The same valve with a ramp and a scaffold.
  sed 's|<Thickness>.*|<Thickness> 0.15 </Thickness>\n<Scaffold_file_path> ring.vtu </Scaffold_file_path>|' plain.xml >ramp.xml
  # Two valves in one tube. The second is read with a scale, and moves more slowly.
  sv_export first tube 0.02 --translate 0,0,-0.6 && sv_export second tube 0.028 --translate 0,0,0.7 || return
  "${write[@]}" scale second 10 || return
  sed -i 's|<Mesh_scale_factor>.*|<Mesh_scale_factor> 10 </Mesh_scale_factor>|; /URIS_face name="box"/,/<.Add_URIS_face>/d' second.xml
  sv_export moving elastic 0.02 || return
  "$python" -B "$OLDPWD/bench/peers/uris_case.py" write fine.msh closed.xml "$sv_work/cases/closed" 0.004
}

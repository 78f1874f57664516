# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run svmultiphysics. `run` sources this file. The steps use $build, $n_jobs, $packages, install_missing,
# python_of_packages, say and step of `run`.

svmultiphysics_packages=(g++ cmake ninja-build libembree-dev libtbb-dev libvtk9-dev libopenmpi-dev openmpi-bin libblas-dev
  liblapack-dev gmsh python3-scipy python3-matplotlib)
svmultiphysics_here=$PWD/examples/svmultiphysics

# ./run svmultiphysics FOLDER
#   Makes riis the valve engine of the svMultiPhysics in FOLDER, whose files stay as they are, and compares both engines: signs,
#   K, the steps in which a valve turns, two ranks, a restart, the drop of a closed valve, and the time. FOLDER is a clone of
#   github.com/SimVascular/svMultiPhysics, commit b5fbed0. The command compiles in build/svmultiphysics and leaves tables and a
#   picture in out/svmultiphysics. Without a FOLDER that holds Code/Source/solver/uris.cpp, the status is 77.
run_svmultiphysics() {
  local solver=${1-} out=$PWD/out/svmultiphysics
  (($# <= 1)) || refuse "'$*' must be one folder"
  if [[ ! -e $solver/Code/Source/solver/uris.cpp ]]; then
    say "skipped: ./run svmultiphysics FOLDER needs the sources of svMultiPhysics, commit b5fbed0, in FOLDER"
    say "git clone https://github.com/SimVascular/svMultiPhysics FOLDER && git -C FOLDER checkout b5fbed0"
    exit 77
  fi
  sv_code=$(realpath -- "$solver")/Code
  packages=("${svmultiphysics_packages[@]}")
  install_missing
  python=$(python_of_packages)
  sv_root=$PWD sv_riis=$PWD/$build/bin/riis sv_work=$PWD/$build/svmultiphysics
  sv_runs=$sv_work/runs
  mkdir -p "$sv_work" "$out"
  rm -rf "$sv_runs" "${out:?}"/*
  mkdir -p "$sv_runs"
  sv_check() { "$python" -B "$svmultiphysics_here/check.py" "$sv_runs" "$@"; }

  step "build the library and the program riis" sv_library
  step "build svMultiPhysics as it is (the longest step)" sv_plain
  step "make riis its valve engine" sv_engine
  step "make the meshes and export the valves" sv_cases
  set_ranks
  step "the closed valve with both engines" sv_closed
  sv_check drop closed closed_solver "$(sv_area closed)" | tee "$out/drop.txt"
  step "a beat with a ramp and a scaffold, with three engines" sv_beats
  sv_check switching beat beat_solver beat_distances | tee "$out/switching.txt"
  sv_check cost beat beat_solver | tee "$out/cost.txt"
  step "the same valve without ramp and scaffold, with three engines" sv_plain_beats
  sv_check switching plain plain_solver plain_distances | tee -a "$out/switching.txt"
  step "two ranks" sv_ranks
  sv_check ranks short short_2 | tee "$out/ranks.txt"
  step "a run that continues while the valve opens, with both engines" sv_restart
  sv_check restart beat continued continued_solver | tee "$out/restart.txt"
  step "Taylor-Hood elements" sv_run th th riis 1 all
  step "a valve that moves in an elastic tube" sv_run fsi fsi riis 1 all
  step "two valves, one of them scaled" sv_run two two riis 1 all
  sv_check signs beat plain short_2 th fsi two | tee "$out/signs.txt"
  sv_check points short short_2 th fsi two continued | tee "$out/points.txt"
  sv_check draw beat beat_solver beat_distances "$out/beat.png"
  step "take the engine out again, which gives the program of before" sv_undo
  say "wrote out/svmultiphysics/*.txt and out/svmultiphysics/beat.png"
}

sv_library() {
  install_library "$sv_work" &&
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

# ---- Cases ----

# sv_mesh NAME KIND EDGE: meshes a tube, or an elastic one with its wall.
sv_mesh() {
  "$python" -B "$svmultiphysics_here/cases.py" "$2" "$3" "$1.geo" && gmsh -3 -format msh2 -o "$1.msh" "$1.geo"
}

# sv_export NAME SECONDS [MESH] [OPTION...]: exports a trileaflet valve that moves in SECONDS, to NAME and NAME.xml.
sv_export() {
  local name=$1 seconds=$2
  shift 2
  rm -rf "$name"
  RIIS_PYTHON=${RIIS_PYTHON-$python} "$sv_riis" export "$name" "$@" --unit cm --valve trileaflet \
    --half-thickness 0.2 --resistance 1e3 --time-step 0.004 --opening-seconds "$seconds" --closing-seconds "$seconds" \
    >"$name.xml"
}

# The paths in the blocks of an export are relative to the working folder.
sv_cases() (
  cd "$sv_work" || exit
  rm -rf cases
  mkdir cases
  write=("$python" -B "$svmultiphysics_here/cases.py")
  sv_mesh tube tube 0.28 && sv_mesh fine tube 0.18 && sv_mesh elastic elastic 0.32 && sv_mesh coarse tube 0.45 &&
    "${write[@]}" scaffold ring.vtu &&
    sv_export plain 0.02 --largest-edge 0.2 && sv_export closed 0.02 fine.msh --largest-edge 0.1 &&
    sv_export first 0.02 --largest-edge 0.2 --translate 0,0,-0.6 &&
    sv_export second 0.028 --largest-edge 0.2 --translate 0,0,0.7 || exit
  # The same valve with a ramp of the half thickness and with a scaffold.
  sed 's|<Thickness>.*|<Thickness> 0.15 </Thickness>\n<Scaffold_file_path> ring.vtu </Scaffold_file_path>|' plain.xml >ramp.xml
  # The second of two valves is read with a scale, and without a box.
  "${write[@]}" scale second 10 &&
    sed -i 's|<Mesh_scale_factor>.*|<Mesh_scale_factor> 10 </Mesh_scale_factor>|
      /URIS_face name="box"/,/<\/Add_URIS_face>/d' second.xml || exit
  "$python" -B "$sv_root/bench/peers/uris_case.py" write fine.msh closed.xml cases/closed 0.004 &&
    "${write[@]}" fluid tube.msh cases/beat 30 20000 0.1 ramp.xml &&
    "${write[@]}" fluid tube.msh cases/short 10 20000 0.1 ramp.xml &&
    "${write[@]}" fluid tube.msh cases/plain 30 20000 0.1 plain.xml &&
    "${write[@]}" fluid tube.msh cases/two 11 20000 0.1 first.xml second.xml &&
    "${write[@]}" taylor-hood coarse.msh cases/th 1 20000 0.1 plain.xml &&
    "${write[@]}" fsi elastic.msh cases/fsi 9 20000 0.1 plain.xml
)

# sv_run NAME CASE ENGINE RANKS CHECK: runs a case in the folder NAME.
sv_run() {
  local folder=$sv_runs/$1 case=$sv_work/cases/$2 engine=$3 ranks=$4 check=$5
  [[ -e $folder ]] || cp -r "$case" "$folder"
  (cd "$folder" && URIS_ENGINE=$engine URIS_CHECK=$check URIS_TABLE=$folder/riis timeout 3600 mpirun -n "$ranks" \
    "$(sv_program)" solver.xml)
}

sv_area() { sed -n 's/.*leaflets in the mesh, \([0-9.e+-]*\);.*/\1/p' "$sv_work/$1.xml"; }

sv_closed() { sv_run closed closed riis 1 none && sv_run closed_solver closed solver 1 none; }

sv_beats() {
  sv_run beat beat riis 1 signs && sv_run beat_solver beat solver 1 none && sv_run beat_distances beat distances 1 none
}

sv_plain_beats() {
  sv_run plain plain riis 1 signs && sv_run plain_solver plain solver 1 none && sv_run plain_distances plain distances 1 none
}

sv_ranks() { sv_run short short riis 1 all && sv_run short_2 short riis 2 all; }

# sv_set NAME ENTRY VALUE: changes an entry of a run's solver.xml.
sv_set() { sed -i "s|\(<$2>\) [a-z0-9]*|\1 $3|" "$sv_runs/$1/solver.xml"; }

# sv_continue NAME ENGINE CHECK: runs five steps, which end while the valve opens, and continues with the restart file.
sv_continue() {
  cp -r "$sv_work/cases/beat" "$sv_runs/$1" &&
    sv_set "$1" Number_of_time_steps 5 &&
    sv_set "$1" Increment_in_saving_restart_files 5 &&
    sv_run "$1" beat "$2" 1 none &&
    sv_set "$1" Number_of_time_steps 12 &&
    sv_set "$1" Continue_previous_simulation true &&
    sv_run "$1" beat "$2" 1 "$3"
}

sv_restart() { sv_continue continued riis all && sv_continue continued_solver solver none; }

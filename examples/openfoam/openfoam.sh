# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run openfoam: fetch OpenFOAM's headers, compile the plug-in, mesh, run, check, draw. `run` sources this file. The
# steps use $build, $n_jobs, $packages, install_missing, is_on_offer, python_of_packages, say and step of `run`.

# Packages that the plug-in needs, and those that ./run openfoam needs.
openfoam_plugin_packages=(openfoam mpi-default-bin openmpi-bin gcc g++ cmake make ninja-build libembree-dev libtbb-dev
  bzip2 xz-utils)
openfoam_packages=("${openfoam_plugin_packages[@]}" gmsh python3-numpy python3-matplotlib)
openfoam_here=examples/openfoam
openfoam_plugin=src/openfoam
# shellcheck source=examples/openfoam/follow.sh
. "$openfoam_here/follow.sh"

# ./run openfoam [plugin [FOLDER] | patient | --short | --size CENTIMETRES | --headers FOLDER]
#   Builds the plug-in for OpenFOAM, and runs a beating valve in OpenFOAM. The command compares marks on 1, 2 and 4 ranks,
#   compares pressure drops with OpenFOAM's porosity, and checks forces and a restart. It leaves plots in out/openfoam. The
#   command downloads OpenFOAM's headers (45 MB), and is left out if there is no package openfoam. --size 0.1 makes edges of
#   0.1 cm. --headers only compiles the plug-in, with the headers of another OpenFOAM. plugin only builds the plug-in, and
#   installs it where the cases of riis patient look for it: in FOLDER, by default ~/.local/lib/riis/openfoam. After ./run demo
#   the command uses the demo's library, and needs half a minute. Otherwise it also compiles a library, and needs a minute and a
#   quarter. patient computes a beat of a synthetic patient, from landmarks to the table, in five minutes of an idle processor.
#   The command fails if a number is out of its bounds.
run_openfoam() {
  of_size=0.16 of_time_step=1e-3 of_half_thickness=1.2e-3
  case $* in
    '') ;;
    plugin | 'plugin '*)
      openfoam_install_plugin "${2:-$HOME/.local/lib/riis/openfoam}"
      return
      ;;
    patient)
      openfoam_patient
      return
      ;;
    --short) of_size=0.25 of_time_step=2e-3 of_half_thickness=1.8e-3 ;;
    --size | '--size '*) of_size=${*:2} ;;
    --headers | '--headers '*) openfoam_headers "${*:2}" && return ;;
    *)
      echo "./run openfoam: '$*' is not an option" >&2
      exit 2
      ;;
  esac
  [[ $of_size =~ ^0\.[0-9]*[1-9][0-9]*$ ]] || {
    echo "./run openfoam: '$of_size' is not a size of edges in centimetres, such as 0.1" >&2
    exit 2
  }
  openfoam_start cases openfoam || return 0
  step "mesh the root" openfoam_mesh "$of_size"
  openfoam_digests

  local python
  python=$(python_of_packages)
  of_check() { "$python" -B "$openfoam_here/check.py" "$@"; }

  step "bad input, which must be refused" openfoam_refusals
  step "bad input of valves that follow the mesh, and of the angle law" openfoam_follow_refusals
  cat "$of_out/refusals.txt"
  step "marks of 1, 2 and 4 ranks" openfoam_marks
  of_check marks "$of_cases"/marks-{1,2,4} | tee "$of_out/marks.txt"
  of_check marks "$of_cases"/symmetric-{1,2,4} | tee -a "$of_out/marks.txt"
  step "a steady flow: closed valve, OpenFOAM's porosity, open valve, no valve" openfoam_drops
  of_check drops "$of_cases" | tee "$of_out/drops.txt"
  step "moving valves, with riisSource and without it" openfoam_moving
  of_check moving "$of_cases" "$of_work"/riis/lib*/libriis.so.1 | tee "$of_out/moving.txt"
  step "the plug-in for the Foundation's OpenFOAM, with a stand-in for its fvModel" openfoam_model
  of_check model "$of_cases"/{hexahedra-28,box-28,rest}-riisSource | tee "$of_out/model.txt"
  step "valves in meshes that move as rigid bodies" openfoam_follow
  of_check follow "$of_cases" | tee "$of_out/follow.txt"
  step "the angle law" openfoam_angle
  of_check angle "$of_cases/angle" "$of_cases/angle-restart" | tee "$of_out/angle.txt"
  if [[ ${1:-} != --short ]]; then
    step "the expected drop and the calibrated drop of closed leaflets" openfoam_expected
    of_check expected "$of_cases"/expected-*-no | tee "$of_out/expected.txt"
    step "a steady flow through the closed valve in four meshes" openfoam_sizes
    of_check sizes "$of_cases"/closed-0.* | tee "$of_out/sizes.txt"
  fi
  step "a heartbeat on 2 ranks, with the leaflets' velocity" openfoam_beat beat yes
  step "a heartbeat on 2 ranks, without the leaflets' velocity" openfoam_beat beat-still no
  of_check beat "$of_cases/beat" "$of_cases/beat-still" | tee "$of_out/beat.txt"
  step "a restart in mid-cycle, with the valve and without one" openfoam_restart
  of_check restart "$of_cases/beat" "$of_cases/beat-restart" "$of_cases/flow" "$of_cases/flow-restart" | tee "$of_out/restart.txt"
  of_check tables "$of_cases/beat" "$of_cases/beat-restart" | tee "$of_out/tables.txt"
  if [[ ${1:-} != --short ]]; then
    step "four heartbeats at 90 mmHg (the longest step)" openfoam_physiological
    of_check physiological "$of_cases/physiological" | tee "$of_out/physiological.txt"
  fi
  of_check pictures "$of_cases/beat" "$of_cases/beat-still" "$of_out"
  say "wrote out/openfoam/beat.png, out/openfoam/velocity.png, and the heartbeat in $of_cases/beat"
}

# openfoam_install_plugin FOLDER: builds the plug-in with the library inside or beside it, so that it can be moved anywhere, and
# installs it. If the build folder has a library, as after ./run demo, the plug-in uses it. Without such a library, the library is
# built while OpenFOAM's headers are fetched.
openfoam_install_plugin() {
  local library=$PWD/$build/src/riis/libriis.so.1 made=static
  openfoam_has_package || exit
  packages=("${openfoam_plugin_packages[@]}")
  install_missing
  of_work=$PWD/$build/openfoam
  mkdir -p "$of_work"
  if [[ -e $library ]]; then
    made=shared
    step "bring the library in $build up to date" cmake --build "$build" --target riis
    openfoam_has_source || exit
    step "build the plug-in" openfoam_build_plugin "$of_work/$made" riisFvOption foamDigest -- -D "RIIS_LIBRARY=$library"
    cp "$library" "$of_work/$made/plugin"
  else
    step "build the library, and fetch OpenFOAM's headers meanwhile (45 MB)" openfoam_library_and_headers
    openfoam_has_source || exit
    step "build the plug-in" openfoam_build_plugin "$of_work/$made" riisFvOption foamDigest
  fi
  mkdir -p "$1"
  rm -f "$1"/lib{riisFvOption,foamDigest}.so "$1/libriis.so.1"
  cp "$of_work/$made"/plugin/lib{riis*,foamDigest}.so* "$1"
  say "the plug-in is in $1"
}

# The kernels keep their -O3. Everything else in the library takes a thousandth of the solver's time, so it is compiled with
# little optimisation. The largest batch of files then compiles in 11 s instead of 17 s.
openfoam_library_and_headers() {
  local fetching status=0
  (openfoam_has_source) &
  fetching=$!
  install_library "$of_work/static" -D BUILD_SHARED_LIBS=OFF -D "CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" || status=$?
  wait "$fetching" || status=$?
  return "$status"
}

# openfoam_cut_off CASE: starts Allrun, and ends it some steps after the first written time.
openfoam_cut_off() {
  local first
  setsid "$1/Allrun" >"$1.cut.log" 2>&1 &
  first=$!
  until grep -q '^Time = 0\.03$' "$1/log.pimpleFoam" 2>/dev/null; do
    kill -0 "$first" 2>/dev/null || {
      cat "$1.cut.log" >&2
      return 1
    }
    sleep 0.1
  done
  kill -- "-$first"
  wait "$first" || say "the beat was cut off"
}

# Follows docs/patient_openfoam.md with the patient of docs/patient.md. The case is cut off once, and then continues.
openfoam_patient() {
  local folder=$PWD/$build/openfoam/patient status=0
  openfoam_install_plugin "$folder.plugin"
  packages=("${demo_packages[@]}" python3)
  install_missing
  step "compile the program" build_demo
  rm -rf "$folder"
  mkdir -p "$folder"
  python3 -B examples/patient/make_patient.py "$folder"
  step "from landmarks to a case" "$build/bin/riis" patient "$folder/root.stl" "$folder/landmarks.mrk.json" \
    --output "$folder/case" --solver openfoam
  export RIIS_OPENFOAM=$folder.plugin
  openfoam_cut_off "$folder/case/openfoam"
  step "a beat" "$folder/case/openfoam/Allrun" || status=$?
  grep -c 'continues at time' "$folder/case/openfoam/log.pimpleFoam"
  python3 "$folder/case/openfoam/report.py" || status=$?
  [[ -s $folder/case/openfoam/flow.png ]] || { echo "Allrun has not drawn flow.png" >&2; status=1; }
  return "$status"
}

# openfoam_build_plugin FOLDER TARGET... [-- OPTION...]: compiles the plug-in in FOLDER/plugin, with the library in FOLDER/riis.
# The options are CMake's.
openfoam_build_plugin() {
  local folder=$1 targets=()
  shift
  while (($# > 0)) && [[ $1 != -- ]]; do
    targets+=("$1")
    shift
  done
  cmake -S "$openfoam_plugin" -B "$folder/plugin" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH="$folder/riis" \
    -D OPENFOAM_SOURCE="$of_source/src" "${@:2}" && cmake --build "$folder/plugin" --target "${targets[@]}"
}

# openfoam_headers FOLDER: compiles the plug-in with the headers of another OpenFOAM, whose sources lie in FOLDER. Nothing is
# linked or run. The Foundation's OpenFOAM has fvModels, and gets the plug-in in the folder foundation.
openfoam_headers() {
  local source=$1/src plugin=$openfoam_plugin part file switches=()
  [[ -d $source/finiteVolume && -d $source/meshTools ]] || {
    echo "./run openfoam: '$1' lacks src/finiteVolume or src/meshTools, so it has no sources of OpenFOAM" >&2
    exit 2
  }
  if [[ -d $source/finiteVolume/cfdTools/general/fvModels ]]; then
    plugin=$plugin/foundation
  else
    switches=(-D "OPENFOAM=$(sed -n 's/^api=//p' "$1/META-INFO/api-info")")
  fi
  for part in OpenFOAM OSspecific/POSIX finiteVolume meshTools; do
    [[ -d $source/$part/lnInclude ]] || "$1/wmake/wmakeLnInclude" -s "$source/$part" || exit
    switches+=(-isystem "$source/$part/lnInclude")
  done
  while read -r file; do
    "${CXX:-g++}" -std=c++17 -c -o /dev/null -fPIC -Wall -Wextra -Werror -DWM_DP -DWM_LABEL_SIZE=32 -DNoRepository \
      -ftemplate-depth-100 "${switches[@]}" -I include -I "$openfoam_plugin" "$plugin/$file" || exit
    say "compiled, and neither linked nor run: $plugin/$file"
  done < <(grep '\.C$' "$plugin/Make/files")
}

# openfoam_start CASES OUT [PACKAGE...]: builds the plug-in, and makes the empty folders build/openfoam/CASES, for cases, and
# out/OUT, for results. With of_keep, the files in these folders are kept. Returns 1 after a message if OpenFOAM is left out.
openfoam_start() {
  openfoam_has_package || return
  packages=("${openfoam_packages[@]}" "${@:3}")
  install_missing
  of_work=$PWD/$build/openfoam
  mkdir -p "$of_work"
  openfoam_has_source || return
  step "build the library and the plug-in" openfoam_build
  openfoam_environment
  of_cases=$of_work/$1 of_out=$PWD/out/$2
  [[ ${of_keep:-} ]] || rm -rf "$of_cases" "$of_out"
  mkdir -p "$of_cases" "$of_out"
}

# Tells whether the distribution has the package openfoam. Prints the reason if the package is missing.
openfoam_has_package() {
  if ! command -v dpkg-query >/dev/null; then
    say "OpenFOAM is left out: this is no Debian system, and the plug-in is built for Debian's package openfoam"
    return 1
  fi
  is_on_offer openfoam || {
    say "OpenFOAM is left out: this distribution has no package openfoam"
    return 1
  }
}

# Gets OpenFOAM's headers from Debian's source package, because the binary packages have none. Prints the reason if the source
# package is not available.
openfoam_has_source() {
  local version folder=$of_work/source
  # shellcheck disable=SC2016 # dpkg-query's own variable
  version=$(dpkg-query -W -f='${source:Version}' openfoam)
  of_source=$folder/$version
  [[ ! -e $of_source/with_dynamicMesh ]] || return 0
  mkdir -p "$folder"
  if ! (step "OpenFOAM's headers, from its source package (45 MB)" openfoam_source "$of_source"); then
    say "OpenFOAM is left out: the source package of openfoam $version, which has its headers, is not available"
    return 1
  fi
}

# openfoam_source FOLDER: gets the headers from the source package of the installed OpenFOAM. The original archive of this package
# contains all of these headers.
openfoam_source() {
  local folder=$1 part
  packaging/apt_fetch.sh source libopenfoam "$folder" \
    src/OpenFOAM src/OSspecific src/finiteVolume src/meshTools src/dynamicMesh || return
  # OpenFOAM's own wmakeLnInclude makes the same links, but starts a process for each of 4,000 files.
  for part in OpenFOAM OSspecific/POSIX finiteVolume meshTools dynamicMesh; do
    mkdir "$folder/src/$part/lnInclude" && (cd "$folder/src/$part/lnInclude" &&
      find .. \( -name lnInclude -o -name Make -o -name config -o -name noLink \) -prune -o -type f \
        \( -name '*.[CHch]' -o -name '*.cc' -o -name '*.hh' -o -name '*.[ch]xx' -o -name '*.[ch]pp' -o -name '*.type' \) \
        -exec ln -s -t . {} +) || return
  done
  touch "$folder/with_dynamicMesh"
}

# install_library FOLDER [OPTION...]: compiles the library alone in FOLDER/library, and installs it to FOLDER/riis. The options
# are those of CMake, such as -D RIIS_WITH_FORTRAN=ON. The commands of other solvers also use this function.
install_library() {
  local folder=$1
  shift
  cmake --preset library -G Ninja -B "$folder/library" -D CMAKE_INSTALL_PREFIX="$folder/riis" "$@" &&
    cmake --build "$folder/library" --parallel "$n_jobs" &&
    cmake --install "$folder/library"
}

openfoam_build() { install_library "$of_work" && openfoam_build_plugin "$of_work" all; }

openfoam_environment() {
  export WM_PROJECT_DIR=/usr/share/openfoam
  export LD_LIBRARY_PATH=$of_work/plugin${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  # There may be more ranks than processors, and the user may be root. The settings in the second line are for Open MPI 4, and
  # those in the third for Open MPI 5.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
  export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
}

# Checks whether function objects work, because Debian 13's OpenFOAM stops at the first one (dictionaryDigest.C). Sets
# $of_with to the words that must stand before OpenFOAM's programs.
openfoam_digests() {
  local digest=$of_work/plugin/libfoamDigest.so log=$of_work/function_object.log
  of_with=()
  (openfoam_function_object) >"$log" 2>&1 && return
  if grep -qF 'error in IOstream "sha1"' "$log"; then
    say "this OpenFOAM fails in every function object, with riis or without: its programs run with LD_PRELOAD=$digest"
    of_with=(env "LD_PRELOAD=$digest")
    (openfoam_function_object) >"$log" 2>&1 && return
  fi
  tail -n 40 "$log"
  say "a function object of OpenFOAM's own fails: $log"
  exit 1
}

openfoam_function_object() { "${of_with[@]}" postProcess -case "$of_work/mesh-$of_size" -func writeCellCentres -time 0; }

# openfoam_mesh SIZE: makes a mesh with edges of SIZE centimetres, in mesh-SIZE.
openfoam_mesh() {
  local folder=$of_work/mesh-$1
  [[ ! -e $folder/complete || $openfoam_here/root.geo -nt $folder/complete ||
    examples/demo/aortic_root.geo -nt $folder/complete ]] || return 0
  rm -rf "$folder"
  cp -r "$openfoam_here/case" "$folder" &&
    gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber size "$1" -format msh22 -o "$folder/root.msh" \
      "$openfoam_here/root.geo" &&
    of_from_gmsh "$folder" "$folder/root.msh" && of_mesh_is_fine "$folder" && touch "$folder/complete"
}

# of_from_gmsh FOLDER FILE: turns a mesh by gmsh into the case's mesh. The patch wall of this mesh becomes a wall.
of_from_gmsh() {
  gmshToFoam -case "$1" "$2" && sed -i '/^ *wall$/,/}/s/patch;/wall;/' "$1/constant/polyMesh/boundary"
}

# of_mesh_is_fine FOLDER: checks the mesh by OpenFOAM's own checkMesh.
of_mesh_is_fine() {
  checkMesh -case "$1" -constant | tee "$1/checkMesh.log" && grep -q '^Mesh OK' "$1/checkMesh.log"
}

# of_case NAME [MESH]: copies the case and the mesh of a folder of $of_work to $of_cases/NAME.
of_case() {
  local folder=$of_cases/$1
  rm -rf "$folder"
  cp -r "$openfoam_here/case" "$folder" &&
    cp -r "$of_work/${2:-mesh-$of_size}/constant/polyMesh" "$folder/constant" &&
    of_set "$1" system/fvOptions aorticValve/halfThickness "$of_half_thickness"
}

# of_set NAME FILE KEY VALUE [KEY VALUE...]: changes entries in a file of the case.
of_set() {
  local file=$of_cases/$1/$2
  shift 2
  while (($# > 1)); do
    foamDictionary "$file" -entry "$1" -set "$2" -disableFunctionEntries >/dev/null 2>&1 || return
    shift 2
  done
}

# of_no_valve NAME: takes the valve and its table out of the case.
of_no_valve() { rm "$of_cases/$1"/system/{fvOptions,valveTable}; }

# of_run NAME RANKS [PARTS]: runs the case, with its output in log.pimpleFoam. PARTS are the ranks along x, y and z.
of_run() {
  local parts=([1]='1 1 1' [2]='2 1 1' [4]='2 2 1')
  if (($2 == 1)); then
    of_logged "$1" pimpleFoam timeout 3600 "${of_with[@]}" pimpleFoam -case "$of_cases/$1"
  else
    of_set "$1" system/decomposeParDict numberOfSubdomains "$2" simpleCoeffs/n "(${3:-${parts[$2]}})" &&
      of_logged "$1" decomposePar "${of_with[@]}" decomposePar -case "$of_cases/$1" &&
      of_logged "$1" pimpleFoam timeout 3600 mpirun -n "$2" "${of_with[@]}" pimpleFoam -case "$of_cases/$1" -parallel
  fi
}

# of_logged NAME PROGRAM COMMAND...: runs the command with its output in log.PROGRAM of the case. Shows the log's end if it fails.
of_logged() {
  local log=$of_cases/$1/log.$2
  shift 2
  "$@" >"$log" 2>&1 && return
  printf 'failed: %s; the end of %s:\n' "$*" "$log" >&2
  tail -n 20 "$log" >&2
  return 1
}

# Runs an opening valve in the tetrahedra and in cubes, and writes every step. With 27 cubes across the valve, some centres lie in
# the planes of symmetry, equally near to two leaflets. OpenFOAM also writes the cell centres.
openfoam_marks() {
  local ranks name mesh
  openfoam_hexahedra 27 || return
  for name in {marks,symmetric}-{1,2,4}; do
    ranks=${name#*-} mesh=mesh-$of_size
    [[ $name != symmetric* ]] || mesh=hexahedra-27
    of_case "$name" "$mesh" &&
      of_set "$name" system/controlDict endTime 0.006 deltaT 1e-3 writeInterval 1 &&
      of_set "$name" system/fvOptions aorticValve/opening \
        '{ law times; openingStart -0.01; openingSeconds 0.04; closingStart 0.1; closingSeconds 0.04; }' &&
      of_run "$name" "$ranks" || return
    if ((ranks == 1)); then
      "${of_with[@]}" postProcess -case "$of_cases/$name" -func writeCellCentres -time 0
    else
      timeout 600 mpirun -n "$ranks" "${of_with[@]}" postProcess -case "$of_cases/$name" -parallel -func writeCellCentres -time 0
    fi || return
  done
}

# of_constant_flow NAME OPENING [SIZE]: makes a case with a given velocity at the inlet, and a valve that does not move.
of_constant_flow() {
  local free_outlet='outlet { type zeroGradient; }' fixed_outlet='outlet { type fixedValue; value uniform 0; }'
  of_case "$1" "${3:+mesh-$3}" &&
    of_set "$1" 0/U boundaryField "{ inlet { type fixedValue; value uniform (0 0 0.1); } $free_outlet wall { type noSlip; } }" &&
    of_set "$1" 0/p boundaryField "{ inlet { type zeroGradient; } $fixed_outlet wall { type zeroGradient; } }" &&
    of_set "$1" system/controlDict endTime 0.01 deltaT 1e-3 writeInterval 10 &&
    of_set "$1" system/fvOptions aorticValve/opening "{ law constant; opening $2; }" aorticValve/velocity no
}

openfoam_drops() {
  local model
  of_constant_flow closed 0 && of_run closed 1 &&
    of_constant_flow aside 0 &&
    of_set aside system/fvOptions aorticValve/offset 0.75 aorticValve/rim cut aorticValve/valve/skirt_length 0.3 &&
    of_run aside 1 &&
    of_constant_flow open 1 && of_run open 1 &&
    of_constant_flow none 1 && of_no_valve none && of_run none 1 || return
  # OpenFOAM's own porosity acts in the same cells as K does. The coefficient of the porosity in a cell differs from K by at most
  # 1/400 of the largest K.
  for model in powerLaw DarcyForchheimer; do
    of_constant_flow "$model" 0 && rm "$of_cases/$model/system/valveTable" &&
      of_check zones "$of_cases/closed" "$of_cases/$model" "$model" && of_run "$model" 1 || return
  done
}

# openfoam_duct NAME: makes a mesh of a duct of 8 x 8 x 24 mm. The mesh of the duct has cubes of 1 mm, tetrahedra, or the dual
# polyhedra.
openfoam_duct() {
  local folder=$of_work/duct-$1
  [[ ! -e $folder/complete ]] || return 0
  rm -rf "$folder"
  cp -r "$openfoam_here/case" "$folder" || return
  if [[ $1 == cubes ]]; then
    of_block "$folder" "-0.004 -0.004 -0.012" "0.004 0.004 0.012" "8 8 24" && blockMesh -case "$folder" || return
  else
    cat >"$folder/duct.geo" <<'END'
Mesh.MeshSizeMin = 0.0012; Mesh.MeshSizeMax = 0.0012;
Point(1) = {-0.004, -0.004, -0.012}; Point(2) = {0.004, -0.004, -0.012};
Point(3) = {0.004, 0.004, -0.012}; Point(4) = {-0.004, 0.004, -0.012};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
out[] = Extrude {0, 0, 0.024} { Surface{1}; };
Physical Surface("inlet") = {1}; Physical Surface("outlet") = {out[0]};
Physical Surface("wall") = {out[2], out[3], out[4], out[5]}; Physical Volume("blood") = {out[1]};
END
    gmsh -3 -nt 1 -format msh22 -o "$folder/duct.msh" "$folder/duct.geo" && of_from_gmsh "$folder" "$folder/duct.msh" || return
    if [[ $1 == polyhedra ]]; then
      (cd "$folder" && polyDualMesh -overwrite 75) || return # it leaves pictures in the present folder
    fi
  fi
  checkMesh -case "$folder" -constant | tee "$folder/checkMesh.log" && touch "$folder/complete"
}

# of_duct MESH HALF_THICKNESS_MM TIME_STEP_MS DEGREES CALIBRATE: runs ten steps of a flow of 0.01 m/s through a closed flat
# leaflet in the duct. The leaflet leans by DEGREES.
# shellcheck disable=SC2016 # a macro of OpenFOAM
of_duct() {
  local name=expected-$1-$2-$3-$4-$5 step dict=system/fvOptions
  step=$(awk -v ms="$3" 'BEGIN { printf "%g", ms / 1000 }')
  of_moving "$name" "duct-$1" "$(awk -v mm="$2" 'BEGIN { printf "%.17g", mm / 1000 }')" PCG 0 || return
  of_set "$name" "$dict" aorticValve/valve '{ kind bileaflet; closed_angle 0; open_angle 1; }' aorticValve/velocity no \
    aorticValve/opening '{ law constant; opening 0; }' aorticValve/placement "{ scale 0.1; rotationAxis (1 0 0);
      rotationAngle $4; translation ($(awk -v degrees="$4" 'BEGIN { a = degrees * atan2(0, -1) / 180;
      printf "-0.07 %.17g %.17g", -0.03 * cos(a), 0.0003 - 0.03 * sin(a) }')); }" &&
    foamDictionary "$of_cases/$name/$dict" -entry aorticValve/calibrate -add "$5" >/dev/null &&
    of_set "$name" 0/U boundaryField '{ inlet { type fixedValue; value uniform (0 0 0.01); } outlet { type zeroGradient; }
      wall { type slip; } }' &&
    of_set "$name" 0/p boundaryField '{ outlet { type fixedValue; value uniform 0; } ".*" { type zeroGradient; } }' &&
    of_set "$name" system/controlDict deltaT "$step" endTime "$(awk -v step="$step" 'BEGIN { print 10 * step }')" \
      writeInterval 10 &&
    of_sum "$name" inflow inlet &&
    echo 'pressure { $inflow; operation areaAverage; fields (p); }' >>"$of_cases/$name/system/functions" && of_run "$name" 1
}

# Twelve closed leaflets, each without calibration and with it: meshes, half thicknesses in mm, time steps in ms, and degrees. One
# of the leaflets restarts with its factor, and runs on 2 and 4 ranks.
openfoam_expected() {
  local mesh half_thickness step degrees calibrate ranks
  for mesh in cubes tetrahedra polyhedra; do openfoam_duct "$mesh" || return; done
  while read -r mesh half_thickness step degrees; do
    for calibrate in no yes; do of_duct "$mesh" "$half_thickness" "$step" "$degrees" "$calibrate" || return; done
  done <<'END'
cubes 1.5 1 0
cubes 2 4 0
cubes 2.5 1 0
cubes 4 4 0
cubes 2 1 20
cubes 3 4 20
tetrahedra 1.2 1 0
tetrahedra 1.6 4 0
tetrahedra 2.2 1 20
polyhedra 2 4 0
polyhedra 2.5 1 0
polyhedra 3 4 20
END
  of_copy expected-cubes-2-1-20-yes factor-restart &&
    of_set factor-restart system/controlDict startTime 0.01 endTime 0.012 writeInterval 2 && of_run factor-restart 1 || return
  for ranks in 2 4; do
    of_copy expected-cubes-2-1-20-yes "factor-ranks-$ranks" && of_run "factor-ranks-$ranks" "$ranks" || return
  done
}

# openfoam_hexahedra N: makes a mesh of the root from cubes, in hexahedra-N. The edges of the cubes are 36 mm / N long. The cubes
# of a box that lie outside the root's surface are removed.
openfoam_hexahedra() {
  local folder=$of_work/hexahedra-$1 layers=$(((13 * $1 + 6) / 12)) top
  [[ ! -e $folder/complete || $openfoam_here/root.geo -nt $folder/complete ]] || return 0
  top=$(awk -v n="$1" -v layers="$layers" 'BEGIN { printf "%.17g", -0.017 + layers * 0.036 / n }')
  rm -rf "$folder"
  cp -r "$openfoam_here/case" "$folder" && mkdir -p "$folder/constant/triSurface" &&
    gmsh -2 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber size 0.08 -format stl -o "$folder/root.stl" \
      "$openfoam_here/root.geo" &&
    of_block "$folder" "-0.018 -0.018 -0.017" "0.018 0.018 $top" "$1 $1 $layers" || return
  cat >"$folder/system/topoSetDict" <<END
FoamFile { version 2.0; format ascii; class dictionary; object topoSetDict; }
actions
(
    {
        name root; type cellSet; action new; source surfaceToCell; file "root.stl"; outsidePoints ((0.0175 0.0175 0));
        includeCut true; includeInside true; includeOutside false; nearDistance -1; curvature -100;
    }
);
END
  blockMesh -case "$folder" && (cd "$folder" && topoSet && subsetMesh -overwrite root -patch wall) &&
    of_mesh_is_fine "$folder" && touch "$folder/complete"
}

# of_block FOLDER LOWER UPPER CELLS: writes blockMesh's dictionary of a box with an inlet, an outlet and walls.
of_block() {
  local a b
  read -r -a a <<<"$2"
  read -r -a b <<<"$3"
  cat >"$1/system/blockMeshDict" <<END
FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }
vertices
(
    (${a[0]} ${a[1]} ${a[2]}) (${b[0]} ${a[1]} ${a[2]}) (${b[0]} ${b[1]} ${a[2]}) (${a[0]} ${b[1]} ${a[2]})
    (${a[0]} ${a[1]} ${b[2]}) (${b[0]} ${a[1]} ${b[2]}) (${b[0]} ${b[1]} ${b[2]}) (${a[0]} ${b[1]} ${b[2]})
);
blocks (hex (0 1 2 3 4 5 6 7) ($4) simpleGrading (1 1 1));
boundary
(
    inlet { type patch; faces ((0 3 2 1)); }
    outlet { type patch; faces ((4 5 6 7)); }
    wall { type wall; faces ((0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7)); }
);
END
}

# of_moving NAME MESH HALF_THICKNESS SOLVER OPENING: makes a case in which the valve opens from OPENING within 40 ms, between
# equal pressures.
of_moving() {
  local name=$1
  rm -rf "${of_cases:?}/$name"
  cp -r "$openfoam_here/case" "$of_cases/$name" &&
    cp -r "$of_work/$2/constant/polyMesh" "$of_cases/$name/constant" &&
    rm "$of_cases/$name/system/functions" "$of_cases/$name/system/valveTable" &&
    of_set "$name" system/fvOptions aorticValve/halfThickness "$3" aorticValve/resistance 1e4 aorticValve/writeLeaflets no \
      aorticValve/opening "{ law times; openingStart 0; openingSeconds 0.04; closingStart 1; closingSeconds 0.04; closed $5; }" &&
    of_set "$name" 0/p boundaryField '{ "inlet|outlet" { type fixedValue; value uniform 0; } wall { type zeroGradient; } }' &&
    of_set "$name" system/controlDict endTime 0.04 writeInterval 40 &&
    of_solver "$name" "$4"
}

# of_solver NAME SOLVER: sets the solver for the pressure: PCG, or riisSource, which calls PCG.
of_solver() {
  [[ $2 == PCG ]] || of_set "$1" system/fvSolution solvers/p/solver riisSource solvers/p/linearSolver PCG
}

# of_closed NAME: turns both ends of the box into walls.
of_closed() {
  of_set "$1" 0/p boundaryField '{ ".*" { type zeroGradient; } }' && of_set "$1" 0/U boundaryField '{ ".*" { type noSlip; } }' &&
    of_set "$1" system/fvSolution PIMPLE/pRefCell 0 PIMPLE/pRefValue 0 &&
    sed -i 's/type  *patch;/type wall;/' "$of_cases/$1/constant/polyMesh/boundary"
}

# of_twice NAME: replaces the valve by two valves at the same place, each with half the resistance.
of_twice() {
  local options=$of_cases/$1/system/fvOptions
  of_set "$1" system/fvOptions aorticValve/resistance 5e3 &&
    sed -n '/^aorticValve/,$ p' "$options" | sed '1 s/aorticValve/secondValve/' >"$options.second" &&
    cat "$options.second" >>"$options"
}

# of_plate NAME CELLS SOLVER: runs a plate that moves in a duct of 10 mm. The plate is a small part of a leaflet of 1.1 m. The
# leaflet turns by one degree about a hinge that is 48 cm away.
of_plate() {
  of_moving "$1" "hexahedra-28" "$(awk -v n="$2" 'BEGIN { print 0.015 / n }')" "$3" 0 &&
    of_set "$1" system/fvOptions aorticValve/valve '{ kind bileaflet; closed_angle 0; open_angle 1; }' \
      aorticValve/placement '{ scale 1; }' &&
    of_block "$of_cases/$1" "0.695 0.295 -0.01" "0.705 0.305 0.02" "$2 $2 $((3 * $2))" &&
    blockMesh -case "$of_cases/$1" >/dev/null &&
    of_sum "$1" inflow inlet && of_sum "$1" outflow outlet && of_run "$1" 1
}

# of_sum NAME FUNCTION PATCH: adds a function object that writes a table of the flow through a patch.
of_sum() {
  printf '%s { type surfaceFieldValue; libs (fieldFunctionObjects); regionType patch; name %s; operation sum; fields (phi);
    writeFields no; log no; }\n' "$2" "$3" >>"$of_cases/$1/system/functions"
}

# of_jet NAME N SOLVER: runs a heartbeat until the valve is open, in a mesh of cubes. The pressure rises as in a heart, and not as
# in the beat of the case. With the pressure of the case, the leaflets would pull the blood faster than the pressure pushes it.
of_jet() {
  of_moving "$1" "hexahedra-$2" "$(of_band "$2")" "$3" 0 &&
    cp "$openfoam_here"/case/system/{fvOptions,functions} "$of_cases/$1/system" &&
    cp "$openfoam_here/case/0/p" "$of_cases/$1/0" &&
    of_set "$1" system/fvOptions aorticValve/halfThickness "$(of_band "$2")" aorticValve/resistance 1e4 &&
    of_set "$1" 0/p boundaryField/inlet/p0 'table ((0 -1) (0.02 -1) (0.05 1.25) (0.14 1.25))' &&
    of_set "$1" system/controlDict endTime 0.1 writeInterval 100 || return
  cat >>"$of_cases/$1/system/functions" <<'END'
below { $upstream; name below; sampledSurfaceDict { pointAndNormalDict { point (0 0 -0.014); } } }
above { $upstream; name above; sampledSurfaceDict { pointAndNormalDict { point (0 0 0.006); } } }
fastest { type volFieldValue; libs (fieldFunctionObjects); regionType all; operation max; fields (U); writeFields no; log no; }
END
  of_run "$1" 1
}

# of_band N: prints the half thickness, 1.5 edges of a cube.
of_band() { awk -v n="$1" 'BEGIN { printf "%.17g", 1.5 * 0.036 / n }'; }

openfoam_moving() {
  local n solver
  for n in 28 32; do
    openfoam_hexahedra "$n" || return
    for solver in PCG riisSource; do
      of_moving "hexahedra-$n-$solver" "hexahedra-$n" "$(of_band "$n")" "$solver" 0 &&
        of_sum "hexahedra-$n-$solver" inflow inlet && of_sum "hexahedra-$n-$solver" outflow outlet &&
        of_run "hexahedra-$n-$solver" 1 && of_jet "jet-$n-$solver" "$n" "$solver" &&
        of_moving "box-$n-$solver" "hexahedra-$n" "$(of_band "$n")" "$solver" 0.3 && of_closed "box-$n-$solver" &&
        of_run "box-$n-$solver" 1 || return
    done
  done
  for solver in PCG riisSource; do
    of_moving "tetrahedra-$solver" "mesh-$of_size" "$of_half_thickness" "$solver" 0 && of_run "tetrahedra-$solver" 1 &&
      of_plate "plate-10-$solver" 10 "$solver" && of_plate "plate-20-$solver" 20 "$solver" || return
  done
  for n in 2 4; do
    of_moving "ranks-$n" hexahedra-28 "$(of_band 28)" riisSource 0 && of_run "ranks-$n" "$n" &&
      of_moving "tetrahedra-ranks-$n" "mesh-$of_size" "$of_half_thickness" riisSource 0 &&
      of_run "tetrahedra-ranks-$n" "$n" || return
  done
  of_moving two-valves hexahedra-28 "$(of_band 28)" riisSource 0 && of_twice two-valves && of_run two-valves 1 &&
    of_moving pisoFoam hexahedra-28 "$(of_band 28)" riisSource 0 &&
    sed -i 's/^PIMPLE/PISO/' "$of_cases/pisoFoam/system/fvSolution" &&
    of_logged pisoFoam pisoFoam timeout 3600 "${of_with[@]}" pisoFoam -case "$of_cases/pisoFoam" || return
  for solver in PCG riisSource; do
    of_moving "rest-$solver" hexahedra-28 "$(of_band 28)" "$solver" 0 &&
      of_set "rest-$solver" system/fvOptions aorticValve/opening '{ law constant; opening 0.5; }' &&
      of_set "rest-$solver" 0/p boundaryField/inlet '{ type fixedValue; value uniform 0.5; }' boundaryField/outlet \
        '{ type fixedValue; value uniform 0; }' &&
      of_set "rest-$solver" system/controlDict endTime 0.005 writeInterval 5 && of_run "rest-$solver" 1 || return
  done
}

# Repeats two moving valves and a valve at rest with modelFoam, each in the case NAME-model.
openfoam_model() {
  local name case
  for name in {hexahedra-28,box-28,rest}-riisSource; do
    case=$of_cases/$name-model
    of_copy "$name" "$name-model" && rm -r "$case"/0.0* "$case/log.pimpleFoam" &&
      sed '/writeLeaflets/d; s/fvOptions;/fvModels;/' "$case/system/fvOptions" >"$case/constant/fvModels" &&
      rm "$case/system/fvOptions" && of_set "$name-model" system/fvSolution solvers/p/solver PCG &&
      of_logged "$name-model" modelFoam timeout 3600 "${of_with[@]}" "$of_work/plugin/modelFoam" -case "$case" || return
  done
}

openfoam_sizes() {
  local size
  for size in 0.16 0.125 0.1 0.08; do
    openfoam_mesh "$size" && of_constant_flow "closed-$size" 0 "$size" &&
      of_set "closed-$size" system/controlDict endTime 0.003 writeInterval 3 && of_run "closed-$size" 1 || return
  done
}

# openfoam_beat NAME VELOCITY: runs a heartbeat. VELOCITY is the value of the key velocity. A second table has its moments about
# another point.
# shellcheck disable=SC2016 # a macro of OpenFOAM
openfoam_beat() {
  of_case "$1" &&
    echo 'shifted { $valve; about (0.01 0.02 0.03); }' >>"$of_cases/$1/system/valveTable" &&
    of_set "$1" system/controlDict deltaT "$of_time_step" writeControl runTime writeInterval 0.02 &&
    of_set "$1" system/fvOptions aorticValve/velocity "$2" && of_run "$1" 2
}

# Runs the heartbeats at 90 mmHg, in the mesh of --short.
openfoam_physiological() {
  openfoam_mesh 0.25 && of_case physiological mesh-0.25 &&
    cp -r "$openfoam_here"/physiological/. "$of_cases/physiological" && of_run physiological 1
}

# Restarts the heartbeat while the valve closes, and writes two later times. For comparison, a flow without a valve continues from
# the same heartbeat, and is also restarted.
openfoam_restart() {
  local before=0.16 time=0.2 end=0.24
  of_copy beat beat-restart && of_go_on beat-restart "$time" "$end" &&
    of_copy beat flow && of_no_valve flow && of_go_on flow "$before" "$end" &&
    of_copy flow flow-restart && of_go_on flow-restart "$time" "$end"
}

# of_copy NAME COPY: copies a case. An existing copy is refused, because cp would put the case inside it.
of_copy() {
  [[ ! -e $of_cases/$2 ]] || { echo "the case $of_cases/$2 is there already" >&2 && return 1; }
  cp -r "$of_cases/$1" "$of_cases/$2"
}

# of_go_on NAME TIME END: continues a case on 2 ranks, from a written time.
of_go_on() {
  of_forget_after "$1" "$2" &&
    of_set "$1" system/controlDict startTime "$2" endTime "$3" &&
    of_logged "$1" pimpleFoam timeout 3600 mpirun -n 2 "${of_with[@]}" pimpleFoam -case "$of_cases/$1" -parallel
}

# of_forget_after NAME TIME: removes the files of later times from a case.
of_forget_after() {
  local folder
  for folder in "$of_cases/$1"/processor*/[0-9]*; do
    ! awk -v a="${folder##*/}" -v b="$2" 'BEGIN { exit !(a > b) }' || rm -r "$folder"
  done
  rm -rf "${of_cases:?}/$1/postProcessing"
}

# of_refused TEXT NAME WORDS: checks that the case stops with the words, and leaves no time folder.
of_refused() {
  local name=$2 log=$of_cases/$2/log.pimpleFoam left
  if of_run "$name" 1 2>/dev/null; then
    echo "$1: it was not refused, and the solver ran to its end" >&2
    return 1
  fi
  grep -qF -- "$3" "$log" || {
    echo "$1: the solver ended, but its log lacks the words '$3': $log" >&2
    return 1
  }
  left=$(find "$of_cases/$name" -maxdepth 1 -name '[0-9]*' ! -name 0 ! -name 0.02)
  [[ ! $left ]] || {
    echo "$1: the solver ended, but it had written $left" >&2
    return 1
  }
  of_tell_refused "$1" "$3"
}

# of_tell_refused TEXT WORDS: adds a line to the table of refusals.
of_tell_refused() { printf '  %-34s refused: %s\n' "$1" "$2" >>"$of_out/refusals.txt"; }

# of_bad NAME: makes a case of two steps, to which a check gives bad input.
of_bad() {
  of_case "$1" && of_set "$1" system/controlDict endTime 2e-3 deltaT 1e-3 writeInterval 2
}

# of_height NAME CENTIMETRES: gives the valve a leaflet height. foamDictionary would keep only six digits of the number.
of_height() {
  sed -i -E "s/kind +trileaflet;.*/kind trileaflet; leaflet_height $2;/" "$of_cases/$1/system/fvOptions" &&
    grep -q "leaflet_height $2;" "$of_cases/$1/system/fvOptions"
}

# of_skirt NAME ENTRY: makes a case whose valve has a skirt, to which ENTRY gives bad input.
of_skirt() {
  of_bad "$1" && foamDictionary "$of_cases/$1/system/fvOptions" -entry aorticValve/skirt -add "$2" >/dev/null
}

# of_arteries NAME ENTRIES: makes a case with arteries at the outlet, to which ENTRIES gives bad input.
of_arteries() {
  of_bad "$1" && of_set "$1" system/controlDict libs '("libriisFvOption.so")' &&
    of_set "$1" 0/p boundaryField/outlet \
      "{ type riisWindkessel; rho 1060; proximalResistance 7e6; distalResistance 1e8; pressure 1e4; $2 }"
}

openfoam_refusals() {
  local dict=system/fvOptions
  of_bad unknown-valve && of_set unknown-valve "$dict" aorticValve/valve/kind pulmonary &&
    of_refused "an unknown valve" unknown-valve "RIIS_INVALID_PARAMETER: 'pulmonary' is not a kind of valve" &&
    of_bad unknown-parameter && of_set unknown-parameter "$dict" aorticValve/valve/leaflet_hight 1 &&
    of_refused "an unknown parameter" unknown-parameter "'leaflet_hight' is not a parameter of the trileaflet valve" &&
    of_skirt skirt-patch '{ patch aorta; longest 0.005; }' &&
    of_refused "a skirt to an unknown patch" skirt-patch "patch is 'aorta', and the mesh has no such patch" &&
    of_skirt skirt-key '{ patch wall; length 0.005; }' &&
    of_refused "an unknown key of the skirt" skirt-key "unknown key 'length'" &&
    of_skirt skirt-zero '{ patch wall; longest 0; }' &&
    of_refused "a skirt without length" skirt-zero 'longest is 0, and must be positive' &&
    of_skirt skirt-inlet '{ patch inlet; longest 0.005; }' &&
    of_refused "a skirt that misses its patch" skirt-inlet 'wall is not within longest, 0.005' &&
    of_bad no-resistance && foamDictionary "$of_cases/no-resistance/$dict" -entry aorticValve/resistance -remove >/dev/null &&
    of_refused "a missing key" no-resistance "Entry 'resistance' not found in dictionary" &&
    of_bad unknown-key && of_set unknown-key "$dict" aorticValve/opening/closesBelow 0 &&
    of_refused "an unknown key" unknown-key "unknown key 'closesBelow'" &&
    of_bad unknown-law && of_set unknown-law "$dict" aorticValve/opening/law swich &&
    of_refused "an unknown law" unknown-law "law is 'swich', and must be constant, times, table, switch or angle" &&
    of_bad unknown-rim && foamDictionary "$of_cases/unknown-rim/$dict" -entry aorticValve/rim -add square >/dev/null &&
    of_refused "an unknown rim" unknown-rim "rim is 'square', and must be round or cut" &&
    of_bad wrong-unit && of_set wrong-unit "$dict" aorticValve/halfThickness '[0 2 0 0 0 0 0] 1e-3' &&
    of_refused "a half thickness in m2" wrong-unit 'The dimensions [0 2 0 0 0 0 0] provided do not match' &&
    of_bad no-half-thickness && of_set no-half-thickness "$dict" aorticValve/halfThickness 0 &&
    of_refused "a half thickness of 0" no-half-thickness 'options.half_thickness is 0; it must be' &&
    of_bad outside && of_set outside "$dict" aorticValve/placement '{ scale 0.01; translation (0 0 1); }' &&
    of_refused "a valve outside the mesh" outside 'at time 0.001: no cell centre lies within the half thickness' &&
    of_bad mode && of_set mode "$dict" aorticValve/selectionMode cellZone &&
    of_refused "another selectionMode" mode "selectionMode is 'cellZone', and must be all" &&
    of_bad fields && of_set fields "$dict" aorticValve/fields '(p)' &&
    of_refused "the field p" fields 'and must be (U), the velocity' &&
    of_bad beside &&
    foamDictionary "$of_cases/beside/$dict" -entry aorticValve/riisValveCoeffs -add '{ rim round; }' >/dev/null &&
    of_refused "keys beside the coefficients" beside "unknown key 'rho'" &&
    of_bad forward && of_set forward "$dict" aorticValve/opening/forward sideways &&
    of_refused "an unknown direction" forward "forward is 'sideways', and must be out or in" &&
    of_bad thin && of_set thin "$dict" aorticValve/halfThickness 2e-4 aorticValve/calibrate yes &&
    of_refused "calibration of a band with holes" thin 'calibrate is yes, but blood passes the closed band in this mesh' &&
    of_bad free && of_set free "$dict" aorticValve/resistance 0 aorticValve/calibrate yes &&
    of_refused "calibration without resistance" free 'calibrate is yes, but resistance is 0' &&
    of_bad other-valve && of_set other-valve system/valveTable valve/valve mitralValve &&
    of_refused "a table of an unknown valve" other-valve "valve is 'mitralValve', and fvOptions has no such riisValve" &&
    of_bad table-key && of_set table-key system/valveTable valve/upstrem '{ }' &&
    of_refused "an unknown key of the table" table-key "unknown key 'upstrem'" &&
    of_bad no-flow && sed -i '/flowPatch/d' "$of_cases/no-flow/system/valveTable" &&
    of_set no-flow "$dict" aorticValve/opening '{ law constant; opening 0; }' &&
    of_refused "a table without flowPatch" no-flow \
      'neither this table nor the law of valve aorticValve has the key flowPatch' &&
    of_bad period && of_set period system/valveTable valve/period -1 &&
    of_refused "a table with a negative period" period 'period is -1, and must be positive' &&
    of_arteries no-compliance '' &&
    of_refused "arteries without compliance" no-compliance "Entry 'compliance' not found in dictionary" &&
    of_arteries compliance 'compliance 0;' &&
    of_refused "arteries with a compliance of 0" compliance 'compliance is 0, and must be positive' &&
    of_arteries arteries 'compliance 1e-8; distal 1e8;' &&
    of_refused "an unknown key of the arteries" arteries "unknown key 'distal'" &&
    of_bad diverges && of_set diverges "$dict" aorticValve/largestSpeed 1e-9 &&
    of_refused "a run that diverges" diverges 'cannot be: halve deltaT in system/controlDict' &&
    of_bad no-patch && of_set no-patch "$dict" aorticValve/opening/flowPatch aorta &&
    of_refused "an unknown patch" no-patch "flowPatch is 'aorta', and the mesh has no such patch" &&
    of_bad not-a-number && of_check nan "$of_cases/not-a-number/0/p" "$of_cases/not-a-number/constant/polyMesh/owner" &&
    of_refused "a pressure that is NaN" not-a-number 'at time 0.001: RIIS_INVALID_ARGUMENT: pressure_difference' &&
    of_bad no-library && of_set no-library "$dict" aorticValve/libs '("libnoValve.so")' &&
    of_refused "a library that is not in the path" no-library 'Unknown fvOption type riisValve' &&
    of_bad no-valve && of_solver no-valve riisSource && of_no_valve no-valve &&
    of_set no-valve system/controlDict libs '("libriisFvOption.so")' &&
    of_refused "riisSource without a valve" no-valve \
      'riisSource solves for p, and fvOptions has no riisValve with this pressure' &&
    of_bad other-pressure && of_solver other-pressure riisSource && of_set other-pressure "$dict" aorticValve/p static \
      aorticValve/opening '{ law constant; opening 0; }' &&
    of_refused "riisSource for another pressure" other-pressure \
      'riisSource solves for p, and fvOptions has no riisValve with this pressure' &&
    of_bad no-solver && of_set no-solver system/fvSolution solvers/p/solver riisSource &&
    of_refused "riisSource without a solver" no-solver "Entry 'linearSolver' not found in dictionary" &&
    of_bad itself && of_set itself system/fvSolution solvers/p/solver riisSource solvers/p/linearSolver riisSource &&
    of_refused "riisSource that calls itself" itself 'linearSolver is riisSource, and must be another solver' &&
    of_bad unknown-solver && of_set unknown-solver system/fvSolution solvers/p/solver riisSource solvers/p/linearSolver PGC &&
    of_refused "a solver that OpenFOAM lacks" unknown-solver 'Unknown symmetric matrix solver type PGC' &&
    of_bad other-state && of_height other-state 1.123456789012 &&
    of_run other-state 1 && mv "$of_cases/other-state/0.002" "$of_cases/other-state/0.02" &&
    of_set other-state system/controlDict startTime 0.02 endTime 0.021 &&
    of_run other-state 1 && grep -q 'continues at time 0.02' "$of_cases/other-state/log.pimpleFoam" &&
    of_set other-state system/controlDict endTime 0.03 &&
    of_height other-state 1.123456789 &&
    of_refused "a restart of another valve" other-state 'this state is that of a valve whose leaflet_height is'
}

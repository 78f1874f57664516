#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_openfoam_script.sh SOURCE WORK
# Checks that examples/openfoam/openfoam.sh refuses faults with the right messages. Functions of this script replace OpenFOAM's
# programs.
# shellcheck disable=SC2317 # openfoam.sh calls the functions
set -euo pipefail
source=$1 work=$2
# shellcheck source=tests/support/script_checks.sh
. "$source/tests/support/script_checks.sh"
rm -rf "$work"
mkdir -p "$work"
cd "$source"

say() { printf '==> %s\n' "$*"; }
# shellcheck source=examples/openfoam/openfoam.sh
. examples/openfoam/openfoam.sh
of_work=$work of_cases=$work/cases of_out=$work/out of_size=0.25 of_with=()
mkdir -p "$of_cases" "$of_out"

# Faulty words on the command line end the script before anything is installed.
ends 2 "./run openfoam: '--shrot' is not an option" run_openfoam --shrot
ends 2 "./run openfoam: '--short --size' is not an option" run_openfoam --short --size
ends 2 "./run openfoam: '' is not a size of edges in centimetres, such as 0.1" run_openfoam --size
ends 2 "./run openfoam: '1.6' is not a size of edges" run_openfoam --size 1.6
ends 2 "./run openfoam: '0.00' is not a size of edges" run_openfoam --size 0.00
ends 2 "./run openfoam: '0.1 0.2' is not a size of edges" run_openfoam --size 0.1 0.2

# --headers compiles the plug-in that fits the headers. The script ends with the compiler's result.
ends 2 "./run openfoam: '' lacks src/finiteVolume or src/meshTools" run_openfoam --headers
ends 2 "./run openfoam: '/nowhere' lacks src/finiteVolume or src/meshTools" run_openfoam --headers /nowhere
fake_cxx() { [[ "$*" != *"$refused_file" ]] && printf '%s\n' "$*" >>"$work/compiled"; }
mkdir -p "$work"/{com,foundation}/src/{OpenFOAM,OSspecific/POSIX,finiteVolume,meshTools}/lnInclude "$work/com/META-INFO"
mkdir -p "$work/foundation/src/finiteVolume/cfdTools/general/fvModels"
echo api=2312 >"$work/com/META-INFO/api-info"
CXX=fake_cxx refused_file=none
ends 0 "compiled, and neither linked nor run: src/openfoam/riisWindkessel.C" run_openfoam --headers "$work/com"
(($(grep -c -- '-D OPENFOAM=2312 .*src/openfoam/riis[A-Za-z]*\.C$' "$work/compiled") == 7)) ||
  problem "--headers compiled other files: $(<"$work/compiled")"
rm "$work/compiled"
ends 0 "compiled, and neither linked nor run: src/openfoam/foundation/riisModel.C" \
  run_openfoam --headers "$work/foundation"
[[ $(<"$work/compiled") == *openfoam/foundation/riisModel.C && $(<"$work/compiled") != *OPENFOAM=* ]] ||
  problem "--headers compiled other files for the Foundation: $(<"$work/compiled")"
refused_file=riisLaw.C
ends 1 "riisValve.C" run_openfoam --headers "$work/com"
unset CXX

# If the build folder has the library, the plug-in uses it. Otherwise the script compiles the library into the plug-in. No file of
# an earlier plug-in remains.
mkdir -p "$work/top"
plugin_in() {
  build=build n_jobs=1 library_fails=${2:-}
  openfoam_has_package() { :; }
  openfoam_has_source() { of_source=$work/headers; }
  install_missing() { :; }
  step() { say "$1" && "${@:2}" || exit; }
  cmake() {
    local folder
    printf '%s\n' "$*" >>"$work/cmake"
    folder=$(sed -n 's/.* -B \([^ ]*plugin\) .*/\1/p' <<<"$*")
    [[ ! $folder ]] || { mkdir -p "$folder" && touch "$folder"/lib{riisFvOption,foamDigest}.so; }
    [[ ! $library_fails || "$*" != *--preset* ]]
  }
  rm -f "$work/cmake"
  cd "$work/top" && openfoam_install_plugin "$1"
}
installed() { (cd "$work/installed" && echo *); }
ends 0 "the plug-in is in $work/installed" plugin_in "$work/installed"
[[ $(installed) == 'libfoamDigest.so libriisFvOption.so' ]] || problem "a plug-in with its library has the files $(installed)"
grep -q -- '--preset library .* -D BUILD_SHARED_LIBS=OFF ' "$work/cmake" || problem "the library is not inside the plug-in"
ends 1 "build the library" plugin_in "$work/installed" fails
mkdir -p "$work/top/build/src/riis"
touch "$work/top/build/src/riis/libriis.so.1"
ends 0 "the plug-in is in $work/installed" plugin_in "$work/installed"
[[ $(installed) == 'libfoamDigest.so libriis.so.1 libriisFvOption.so' ]] ||
  problem "a plug-in with the library beside it has the files $(installed)"
grep -q -- "--build build --target riis$" "$work/cmake" || problem "the library may be out of date"
grep -q -- "-D RIIS_LIBRARY=$work/top/build/src/riis/libriis.so.1" "$work/cmake" || problem "the plug-in has another library"
rm "$work/top/build/src/riis/libriis.so.1"
ends 0 "the plug-in is in $work/installed" plugin_in "$work/installed"
[[ $(installed) == 'libfoamDigest.so libriisFvOption.so' ]] || problem "the former library is left: $(installed)"

# A run with bad input must stop with the expected message, and leave no time folder.
solver_says='' solver_ends=1 solver_leaves=''
of_run() {
  mkdir -p "$of_cases/$1/0"
  printf '%s\n' "$solver_says" >"$of_cases/$1/log.pimpleFoam"
  [[ ! $solver_leaves ]] || mkdir -p "$of_cases/$1/$solver_leaves"
  return "$solver_ends"
}
solver_says="error: unknown key 'closesBelow'"
ends 0 "" of_refused "an unknown key" bad "unknown key 'closesBelow'"
grep -qx "  an unknown key  *refused: unknown key 'closesBelow'" "$of_out/refusals.txt" ||
  problem "the refusal is not in refusals.txt"
solver_ends=0
ends 1 "an unknown key: it was not refused, and the solver ran to its end" \
  of_refused "an unknown key" bad "unknown key 'closesBelow'"
solver_ends=1 solver_says='Segmentation fault'
ends 1 "an unknown key: the solver ended, but its log lacks the words 'unknown key 'closesBelow'': $of_cases/bad/log.pimpleFoam" \
  of_refused "an unknown key" bad "unknown key 'closesBelow'"
solver_says="unknown key 'closesBelow'" solver_leaves=0.002
ends 1 "an unknown key: the solver ended, but it had written $of_cases/bad/0.002" \
  of_refused "an unknown key" bad "unknown key 'closesBelow'"
(($(wc -l <"$of_out/refusals.txt") == 1)) || problem "refusals.txt has what was not refused: $(<"$of_out/refusals.txt")"

# If a program fails, the script shows the end of its log.
mkdir -p "$of_cases/logged"
ends 1 "failed: sh -c echo its last words; exit 7; the end of $of_cases/logged/log.sh:
its last words" of_logged logged sh sh -c 'echo its last words; exit 7'
ends 0 "" of_logged logged sh true

# A mesh that checkMesh refuses must not be kept.
gmsh() { :; }
gmshToFoam() {
  mkdir -p "$2/constant/polyMesh"
  printf '    wall\n    {\n        type patch;\n    }\n' >"$2/constant/polyMesh/boundary"
}
checkMesh() { printf '%s\n' "$mesh_says"; }
mesh_says='Failed 1 mesh checks.'
ends 1 "Failed 1 mesh checks." openfoam_mesh 0.25
[[ ! -e $of_work/mesh-0.25/complete ]] || problem "a mesh that failed its checks is kept"
mesh_says='Mesh OK.'
ends 0 "Mesh OK." openfoam_mesh 0.25
[[ -e $of_work/mesh-0.25/complete ]] || problem "a good mesh is not kept"
grep -q 'type wall;' "$of_work/mesh-0.25/constant/polyMesh/boundary" || problem "the wall is no wall"

# Tests the check of function objects. In three cases, function objects work, need the digest of the plug-in's folder, or fail for
# another reason.
function_objects=good
openfoam_function_object() {
  case $function_objects in
    good) ;;
    sha1) ((${#of_with[@]})) || { echo 'error in IOstream "sha1" for operation' && return 1; } ;;
    other) echo 'error in IOstream "points"' && return 1 ;;
  esac
}
with_digests() { openfoam_digests && echo "with: ${of_with[*]}"; }
ends 0 "with: " with_digests
function_objects=sha1
ends 0 "this OpenFOAM fails in every function object, with riis or without" with_digests
ends 0 "with: env LD_PRELOAD=$of_work/plugin/libfoamDigest.so" with_digests
function_objects=other
[[ $(with_digests) != *LD_PRELOAD* ]] || problem "another error brings the digest"
ends 1 "error in IOstream \"points\"
==> a function object of OpenFOAM's own fails: $of_work/function_object.log" with_digests

# A case must not be copied into an existing folder.
mkdir -p "$of_cases/first" "$of_cases/second"
ends 1 "the case $of_cases/second is there already" of_copy first second
[[ ! -e $of_cases/second/first ]] || problem "the copy is inside the case"
ends 0 "" of_copy first third
[[ -d $of_cases/third ]] || problem "there is no copy"

# A restart continues from a time. Later times are removed, and earlier times are kept.
mkdir -p "$of_cases/beat/processor0/"{0,0.16,0.2,0.22,0.3,1e-05,constant} "$of_cases/beat/postProcessing"
of_forget_after beat 0.2
left=$(cd "$of_cases/beat" && echo processor0/* postProcessing*)
[[ $left == 'processor0/0 processor0/0.16 processor0/0.2 processor0/1e-05 processor0/constant postProcessing*' ]] ||
  problem "after of_forget_after there is: $left"

# of_height must add a leaflet height that the dictionary lacks. Otherwise the test of a restart would run without a changed
# valve.
mkdir -p "$of_cases/tall/system"
echo 'valve { kind trileaflet; }' >"$of_cases/tall/system/fvOptions"
ends 0 "" of_height tall 1.123456789012
grep -q 'leaflet_height 1.123456789012;' "$of_cases/tall/system/fvOptions" || problem "the dictionary lacks the height"
echo 'valve { kind aortic; }' >"$of_cases/tall/system/fvOptions"
ends 1 "" of_height tall 1.123456789012

# The second valve is a copy of the first with another name.
mkdir -p "$of_cases/twice/system"
first=$'{\n    type riisValve;\n}'
printf 'FoamFile { }\naorticValve\n%s\n' "$first" >"$of_cases/twice/system/fvOptions"
of_set() { :; }
ends 0 "" of_twice twice
[[ $(<"$of_cases/twice/system/fvOptions") == $'FoamFile { }\naorticValve\n'"$first"$'\nsecondValve\n'"$first" ]] ||
  problem "the second valve is not a copy: $(<"$of_cases/twice/system/fvOptions")"

((failed)) || echo "the checks of openfoam.sh refuse what they must"
exit "$failed"

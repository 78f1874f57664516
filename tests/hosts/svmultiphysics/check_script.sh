#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_script.sh SOURCE WORK
# Checks the messages of ./run svmultiphysics without the solver, and the effect of riis.cmake on a made-up solver. riis.cmake
# refuses unknown sources, replaces two functions, changes no source, and can be undone.
# shellcheck disable=SC2317 # ends calls the functions
set -euo pipefail
source=$1 work=$2
# shellcheck source=tests/support/script_checks.sh
. "$source/tests/support/script_checks.sh"
command -v cmake >/dev/null && command -v ninja >/dev/null || exit 77
rm -rf "$work"
mkdir -p "$work"/{Code,ours,riis}
work=$(realpath "$work")

ends 77 "needs the sources of svMultiPhysics, commit b5fbed0, in FOLDER" "$source/run" svmultiphysics
ends 77 "checkout b5fbed0" "$source/run" svmultiphysics "$work"
ends 2 "must be one folder" "$source/run" svmultiphysics "$work" "$work"

# The made-up solver prints which functions it calls.
cat >"$work/Code/CMakeLists.txt" <<'END_OF_FILE'
cmake_minimum_required(VERSION 3.20)
project(SV CXX)
add_executable(svmultiphysics main.cpp uris.cpp)
END_OF_FILE
cat >"$work/Code/main.cpp" <<'END_OF_FILE'
void uris_calc_sdf();
void eval_uris_ris_factors_quadrature();
int main() { uris_calc_sdf(), eval_uris_ris_factors_quadrature(); }
END_OF_FILE
cat >"$work/Code/uris.cpp" <<'END_OF_FILE'
#include <cstdio>
void uris_calc_sdf() { std::puts("solver's distances"); }
void eval_uris_ris_factors_quadrature() { std::puts("solver's K"); }
END_OF_FILE
# Our files lie beside a copy of riis.cmake and a library.
cp "$source/examples/svmultiphysics/riis.cmake" "$work/ours"
cat >"$work/ours/uris_riis.cpp" <<'END_OF_FILE'
#include <cstdio>
#include <made_up_riis.h>
void sv_calc_sdf();
void sv_factors();
void uris_calc_sdf() { std::puts(RIIS_WORD "distances"), sv_calc_sdf(); }
void eval_uris_ris_factors_quadrature() { std::puts(RIIS_WORD "K"), sv_factors(); }
END_OF_FILE
cat >"$work/ours/uris_check.cpp" <<'END_OF_FILE'
#include <cstdio>
void riis_calc_sdf();
void riis_factors();
void uris_calc_sdf() { std::puts("compared"), riis_calc_sdf(); }
void eval_uris_ris_factors_quadrature() { riis_factors(); }
END_OF_FILE
mkdir "$work/riis/include"
echo '#define RIIS_WORD "our "' >"$work/riis/include/made_up_riis.h"
: | "${CXX:-c++}" -x c++ -shared -fPIC -o "$work/riis/libmade_up.so" -
cat >"$work/riis/riis-config.cmake" <<'END_OF_FILE'
add_library(riis::riis SHARED IMPORTED)
set_target_properties(riis::riis PROPERTIES IMPORTED_LOCATION ${CMAKE_CURRENT_LIST_DIR}/libmade_up.so
  INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR}/include)
END_OF_FILE

configure() { cmake -G Ninja -S "$work/Code" -B "$work/build" "$@"; }
compile() { ninja -C "$work/build"; }
with_riis=(-D CMAKE_PROJECT_SV_INCLUDE="$work/ours/riis.cmake" -D riis_DIR="$work/riis")
before=$(tree_of "$work/Code")

ends 0 "" configure
ends 0 "" compile
plain=$(sha256sum "$work/build/svmultiphysics")
[[ $("$work/build/svmultiphysics") == $'solver\'s distances\nsolver\'s K' ]] || problem "the made-up solver is wrong"

# Another version of uris.cpp is refused, and the message states its version.
version=$(sha256sum "$work/Code/uris.cpp" | cut -c -64)
ends 1 "$version" configure "${with_riis[@]}"
sed -i "s/^set(riis_known_versions/& $version/" "$work/ours/riis.cmake"

ends 0 "" configure "${with_riis[@]}"
ends 0 "uris_riis.cpp" compile
ours=$'our distances\nsolver\'s distances\nour K\nsolver\'s K'
[[ $("$work/build/svmultiphysics") == "$ours" ]] || problem "the functions are not replaced: $("$work/build/svmultiphysics")"
! ninja -C "$work/build" -t commands | grep main.cpp | grep -q riis/include || problem "main.cpp gets our include folder"
# The second build with the same options compiles nothing again.
ends 0 "" configure "${with_riis[@]}"
ends 0 "no work to do" compile
# With this option, both engines run in each step.
ends 0 "" configure "${with_riis[@]}" -D RIIS_URIS_CHECK=ON
ends 0 "uris_check.cpp" compile
[[ $("$work/build/svmultiphysics") == compared$'\n'"$ours" ]] || problem "the engines are not compared"
# After the change is undone, the program is the same as before.
ends 0 "" configure -U CMAKE_PROJECT_SV_INCLUDE
ends 0 "" compile
[[ $(sha256sum "$work/build/svmultiphysics") == "$plain" ]] || problem "the program differs after the undo"
[[ $(tree_of "$work/Code") == "$before" ]] || problem "the solver's sources have changed"

((failed)) || echo "riis.cmake replaces the engine of a made-up solver, and can be undone"
exit "$failed"

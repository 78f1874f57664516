#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# compilers.sh SOURCE FOLDER [all]
# Builds the core with every compiler and standard library that is installed here, and prints a line for each: whether 60 states
# have the bits of tests/process/state_digests.txt in every run, and whether the core compiles as C++20 and C++23. Warnings are
# errors. With the word all, each compiler also reads all files of the preset default: program, tests and benchmarks.
# FOLDER keeps the compiled files and a log for each line.
set -euo pipefail
source=$1 folder=$2 words=${3:-}
mkdir -p "$folder"

# shellcheck source=/dev/null
system=$(. /etc/os-release && echo "${ID^} ${VERSION_ID:-}")
read -r _ libc < <(getconf GNU_LIBC_VERSION)

# configure FOLDER C++_COMPILER C_COMPILER FLAGS OPTION...
configure() {
  local to=$1 cxx=$2 cc=$3 flags=$4
  shift 4
  cmake -S "$source" -B "$to" -G Ninja -D CMAKE_BUILD_TYPE=Release -D RIIS_WARNINGS_AS_ERRORS=ON -D RIIS_UNITY_CORE=ON \
    -D CMAKE_CXX_COMPILER="$cxx" -D CMAKE_C_COMPILER="$cc" -D CMAKE_CXX_FLAGS="$flags" -D CMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON "$@"
}

# check_bits FOLDER C++_COMPILER C_COMPILER FLAGS: the core has the expected bits.
check_bits() {
  configure "$@" -D RIIS_WITH_VTK=OFF -D RIIS_WITH_FORTRAN=OFF -D RIIS_BUILD_PROGRAM=OFF -D RIIS_BUILD_TESTS=OFF \
    -D RIIS_BUILD_BENCH=OFF &&
    cmake --build "$1" --target riis &&
    "$3" -std=c11 -O1 -ffp-contract=off -I "$source/include" "$source/tests/process/state_digests.c" -o "$1/state_digests" \
      -L "$1/src/riis" -lriis -lm -Wl,-rpath,"$1/src/riis" &&
    "$source/tests/process/check_same_bits.sh" "$1/state_digests" "$source/tests/process/state_digests.txt" all
}

# check_all FOLDER C++_COMPILER C_COMPILER FLAGS: the compiler reads all files of the preset default.
check_all() {
  configure "$1" "$2" "$3" "$4" --preset default -D RIIS_WITH_FORTRAN=OFF &&
    "$source/tests/debian/read_sources.py" "$1" c++17 c++20 c++23
}

status=0
# row NAME VERSION LIBRARY COMMAND...: runs the commands of a line.
row() {
  local cxx=$1 cc=$2 library=$3 flags=$4 name bits standards whole=''
  name=$folder/$cxx-${library%% *}
  check_bits "$name" "$cxx" "$cc" "$flags" >"$name.log" 2>&1 &&
    bits="the same in $(grep -c ': the same bits$' "$name.log") runs" || bits="other bits, or an error: $name.log" status=1
  "$source/tests/debian/read_sources.py" "$name" c++20 c++23 >"$name.standards.log" 2>&1 && standards='20, 23' ||
    standards="error: $name.standards.log" status=1
  if [[ $words == all ]]; then
    check_all "$name-all" "$cxx" "$cc" "$flags" >"$name.all.log" 2>&1 && whole=$(tail -n 1 "$name.all.log") ||
      whole="error: $name.all.log" status=1
  fi
  printf '%-10s | %-14s | %-12s | glibc %s | %-22s | %-8s | %s\n' "$system" "$cxx $("$cxx" -dumpfullversion 2>/dev/null ||
    "$cxx" -dumpversion)" "$library" "$libc" "$bits" "$standards" "$whole"
}

for version in 12 13 14; do
  ! command -v "g++-$version" >/dev/null || row "g++-$version" "gcc-$version" libstdc++ ''
done
for version in 14 19; do
  command -v "clang++-$version" >/dev/null || continue
  row "clang++-$version" "clang-$version" libstdc++ -stdlib=libstdc++
  row "clang++-$version" "clang-$version" libc++ -stdlib=libc++
done
exit "$status"

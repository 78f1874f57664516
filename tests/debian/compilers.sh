#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# compilers.sh SOURCE FOLDER all|quick|musl|'' [COMPILER...]
# Builds the core with every compiler and standard library that is installed here, or with the named compilers. Prints a line for
# each compiler. The line says whether 60 states have the bits of tests/process/state_digests.txt in every run, and whether the
# core compiles as C++20 and C++23. Warnings are errors. With the word all, each compiler also reads all files of the preset
# default: program, tests and benchmarks. With the word quick, the core is compiled only as C++17 with -O1, and the states are
# made only three times. With the word musl, clang only reads the core's files, with the headers of the C library musl. FOLDER
# keeps the compiled files and a log for each line.
# shellcheck disable=SC2317 # functions are called by their names
set -euo pipefail
source=$1 folder=$2 mode=$3
shift 3
wanted=" $* "
mkdir -p "$folder"
status=0 n_rows=0

# shellcheck source=/dev/null
system=$(. /etc/os-release && echo "${ID^} ${VERSION_ID:-}")
read -r _ libc < <(getconf GNU_LIBC_VERSION)

# configure FOLDER PRESET: configures with the compiler $cxx. Reading the files must not need precompiled headers.
configure() {
  local level=-O3
  [[ $mode != quick ]] || level=-O1
  cmake -S "$source" -B "$1" -G Ninja --preset "$2" -D RIIS_WARNINGS_AS_ERRORS=ON -D RIIS_UNITY_CORE=ON \
    -D CMAKE_CXX_FLAGS_RELEASE="$level -DNDEBUG" -D RIIS_KERNEL_LEVEL="$level" -D CMAKE_CXX_COMPILER="$cxx" \
    -D CMAKE_C_COMPILER="$cc" -D CMAKE_CXX_FLAGS="$flags" -D CMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON -D RIIS_WITH_FORTRAN=OFF
}

# bits FOLDER: builds the core and compares its bits.
bits() {
  local runs=all
  [[ $mode != quick ]] || runs=''
  configure "$1" library &&
    cmake --build "$1" --target riis --parallel "$(nproc)" &&
    "$cc" -std=c11 -O1 -ffp-contract=off -I "$source/include" "$source/tests/process/state_digests.c" -o "$1/state_digests" \
      -L "$1/src/riis" -lriis -lm -Wl,-rpath,"$1/src/riis" &&
    "$source/tests/process/check_same_bits.sh" "$1/state_digests" "$source/tests/process/state_digests.txt" "$runs"
}

# all_files FOLDER: reads all files of the preset default.
all_files() { configure "$1" default && "$source/tests/debian/read_sources.py" "$1" c++17 c++20 c++2b; }

# tried LOG COMMAND...: runs the command with its output in a log. Returns the status. If the command fails, prints the log's
# path.
tried() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 && return
  printf 'failed: %s' "$log"
  return 1
}

# row COMPILER C_COMPILER LIBRARY FLAGS
row() {
  [[ $wanted == "  " || $wanted == *" $1 "* ]] || return 0
  n_rows=$((n_rows + 1))
  local cxx=$1 cc=$2 library=$3 flags=$4 name=$folder/${mode:+$mode-}$1-$3 same more=''
  if same=$(tried "$name.log" bits "$name"); then
    same="$(grep -c ': the same bits$' "$name.log") runs: the same"
    ! grep -q ': not tested' "$name.log" || same+=", $(grep -c ': not tested' "$name.log") not possible"
  else
    status=1
  fi
  if [[ $mode != quick ]]; then
    # clang 14 knows C++23 only by its earlier name, which all compilers know.
    more=$(tried "$name.standards.log" "$source/tests/debian/read_sources.py" "$name" c++20 c++2b) || status=1
    more=" | ${more:-C++20 and C++23: no warning}"
  fi
  if [[ $mode == all ]]; then
    local whole
    whole=$(tried "$name.all.log" all_files "$name-all") || status=1
    more+=" | ${whole:-$(tail -n 1 "$name.all.log")}"
  fi
  printf '%s, glibc %s | %s %s | %s | %s%s\n' "$system" "$libc" "$cxx" "$("$cxx" -dumpfullversion -dumpversion)" "$library" \
    "$same" "$more"
}

# musl FOLDER: reads the core's files with the headers of musl and libc++. The headers of Embree and TBB are this system's.
musl() {
  local name llvm
  configure "$1" library || return
  llvm=/usr/lib/llvm-$("$cxx" -dumpversion | sed 's/\..*//')
  rm -rf "$1/headers"
  mkdir "$1/headers"
  for name in /usr/include/{embree*,tbb,oneapi}; do ln -s "$name" "$1/headers"; done
  "$source/tests/debian/read_sources.py" "$1" c++17 --target=x86_64-linux-musl -nostdinc -nostdinc++ -D_LIBCPP_HAS_MUSL_LIBC \
    "-isystem$llvm/include/c++/v1" "-isystem$("$cxx" -print-resource-dir)/include" -isystem/usr/include/x86_64-linux-musl \
    "-isystem$1/headers"
}

if [[ $mode == musl ]]; then
  cxx=clang++ cc=clang flags=''
  tried "$folder/musl.log" musl "$folder/musl" || { echo && exit 1; }
  echo "$system, musl | clang++ $(clang++ -dumpversion) | libc++ | $(tail -n 1 "$folder/musl.log")"
  exit
fi
for version in 12 13 14; do
  ! command -v "g++-$version" >/dev/null || row "g++-$version" "gcc-$version" libstdc++ ''
done
for version in 14 19; do # clang needs the libomp of its version
  [[ -e /usr/bin/clang++-$version && -e /usr/lib/llvm-$version/lib/libomp.so ]] || continue
  for library in libc++ libstdc++; do row "clang++-$version" "clang-$version" "$library" "-stdlib=$library"; done
done
((n_rows > 0)) || { echo "compilers.sh: none of these compilers is installed:$wanted" >&2; exit 1; }
exit "$status"

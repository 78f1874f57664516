#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cmake.sh ROWS: uses the source archive from another project, by find_package, FetchContent and add_subdirectory, with shared and
# static libraries. The programs in C, C++ and Fortran must mark the same bits in all six ways. The libraries are built without
# optimisation, to compile fast. Appends a line for each way to the file ROWS. CMAKE names another CMake, such as the oldest that
# riis supports.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
[[ $# == 1 ]] || { echo "usage: packaging/cmake.sh ROWS" >&2; exit 2; }
rows=$(realpath -m -- "$1") cmake=${CMAKE:-cmake} work=$PWD/build/packages-cmake
logs=$work
options=(-G Ninja -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG=-O0 -D CMAKE_Fortran_FLAGS_DEBUG=-O0
  -D RIIS_KERNEL_LEVEL=-O0)

# build FOLDER: builds the folder of the work folder.
build() { logged "build-$1" "$cmake" --build "$work/$1" --parallel "$(nproc)"; }

packaging/dist.sh archive
rm -rf "$work"
mkdir -p "$work"
tar -xJf out/dist/riis-*.tar.xz -C "$work"
mv "$work"/riis-* "$work/source"
version=$("$cmake" --version | sed -n 's/^cmake version //p')
for kind in shared static; do
  shared=$([[ $kind == shared ]] && echo ON || echo OFF)
  say "riis, $kind, by CMake $version"
  logged "configure-$kind" "$cmake" -S "$work/source" -B "$work/$kind" "${options[@]}" -D BUILD_SHARED_LIBS="$shared" \
    -D RIIS_WITH_VTK=OFF -D RIIS_BUILD_TESTS=OFF -D RIIS_BUILD_BENCH=OFF
  build "$kind"
  logged "install-$kind" "$cmake" --install "$work/$kind" --prefix "$work/prefix-$kind"
  for way in find_package FetchContent add_subdirectory; do
    logged "configure-$kind-$way" "$cmake" -S "$work/source/tests/install/stranger" -B "$work/$kind-$way" "${options[@]}" \
      -D BUILD_SHARED_LIBS="$shared" -D RIIS_FROM="$way" -D RIIS_SOURCE="$work/source" -D CMAKE_PREFIX_PATH="$work/prefix-$kind"
    build "$kind-$way"
    for language in c cpp fortran; do
      "$work/$kind-$way/marks_$language" >"$work/marks.txt"
      same_marks "CMake-$kind-$way-$language" "$work/marks.txt"
    done
    library=$(find "$work/$kind" -name "libriis.so.?" -o -name libriis.a | head -n 1)
    row "CMake $version, $way" "$kind" "$([[ $way == find_package ]] && echo "a prefix" || echo "as a part")" \
      "C, C++, Fortran: same bits" "$(size "$library")"
  done
done

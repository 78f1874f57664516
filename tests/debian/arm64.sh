#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# arm64.sh SOURCE FOLDER
# Compiles the core for 64-bit ARM, and compares the bits of 60 states with those of this machine. An emulator runs the program,
# 20 times as long as a processor. FOLDER keeps the compiled files, and Debian's libraries for ARM. apt fetches them there, and
# this system's own packages stay as they are.
set -euo pipefail
source=$1 folder=$2
root=$folder/root libraries=usr/lib/aarch64-linux-gnu
packages=(libc6 libgcc-s1 libstdc++6 libgomp1 libembree3-3 libembree-dev libtbb12 libtbb-dev libtbbmalloc2 libtbbbind-2-5
  libhwloc15 libudev1)

if [[ ! -e $root ]]; then
  mkdir -p "$folder"/apt/{state/lists/partial,cache/archives/partial} "$folder/debs"
  : >"$folder/apt/status"
  apt_options=(-o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State="$folder/apt/state"
    -o Dir::State::status="$folder/apt/status" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root)
  apt-get "${apt_options[@]}" -qq update
  (cd "$folder/debs" && apt-get "${apt_options[@]}" -qq download "${packages[@]}")
  for package in "$folder"/debs/*.deb; do dpkg -x "$package" "$root.partial"; done
  mv "$root.partial" "$root"
fi

cmake -S "$source" -B "$folder/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D RIIS_WARNINGS_AS_ERRORS=ON \
  -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=aarch64 -D CMAKE_FIND_ROOT_PATH="$root" \
  -D CMAKE_C_COMPILER=aarch64-linux-gnu-gcc -D CMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
  -D CMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -D CMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
  -D CMAKE_EXE_LINKER_FLAGS="-Wl,-rpath-link,$root/$libraries" \
  -D RIIS_WITH_VTK=OFF -D RIIS_WITH_FORTRAN=OFF -D RIIS_BUILD_PROGRAM=OFF -D RIIS_BUILD_TESTS=OFF -D RIIS_BUILD_BENCH=OFF
cmake --build "$folder/build" --target riis
library=$(dirname "$(find "$folder/build" -name libriis.so)")
aarch64-linux-gnu-gcc -std=c11 -O1 -ffp-contract=off -I "$source/include" "$source/tests/process/state_digests.c" \
  -o "$folder/state_digests" -L "$library" -lriis -lm -Wl,-rpath-link,"$root/$libraries"
paths=$library:$root/$libraries:$root/lib/aarch64-linux-gnu
qemu-aarch64-static -L "$root" -E LD_LIBRARY_PATH="$paths" "$folder/state_digests" >"$folder/digests.txt"
diff "$source/tests/process/state_digests.txt" "$folder/digests.txt"
echo "arm64: the same bits in $(($(wc -l <"$folder/digests.txt") - 1)) states"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# arm64.sh root FOLDER                   unpacks Debian's packages for 64-bit ARM in FOLDER/root, on the first call only
# arm64.sh build SOURCE FOLDER           compiles everything for ARM in FOLDER/build
# arm64.sh test SOURCE FOLDER [WORD...]  runs the tests whose names match a WORD, or the default suite, and judges the results
# An emulator runs the programs for ARM. It needs 7 to 20 times as long as a processor. apt fetches the packages and dpkg unpacks
# them. This system's own packages stay as they are, and no step needs root rights.
set -euo pipefail

triplet=aarch64-linux-gnu
# What the tests of ./run test need, as in the lists of run, and the C and Fortran libraries.
packages=(libstdc++-12-dev libgfortran-12-dev
  libembree-dev libtbb-dev
  libvtk9-dev libx11-dev nlohmann-json3-dev libcli11-dev libhdf5-dev libgl1-mesa-dri
  libcmocka-dev libopenmpi-dev)

make_root() {
  local folder=$1 part=$1/root.part link package options stated="(^|[^A-Za-z0-9_./}-])(/usr/lib/$triplet/)"
  [[ ! -e $folder/root ]] || return 0
  rm -rf "$folder/apt" "$part"
  mkdir -p "$folder"/apt/{state/lists/partial,cache/archives/partial} "$part"/usr/{bin,lib,sbin}
  : >"$folder/apt/status"
  options=(-o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State="$folder/apt/state"
    -o Dir::State::status="$folder/apt/status" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" -qq update
  apt-get "${options[@]}" -q install --download-only --yes --no-install-recommends "${packages[@]}"
  # In this system these folders are links too. A folder for ARM covers one of this system, so both need the same layout.
  for link in bin lib sbin; do ln -s "usr/$link" "$part/$link"; done
  for package in "$folder"/apt/cache/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink --no-same-owner -C "$part"
  done
  # The cross compiler follows links outside the emulated system.
  find "$part" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$part$(readlink "$link")" "$link"
  done
  # CMake does not look for a library whose path a package's file states.
  grep -rlE --include='*argets*.cmake' "$stated" "$part/usr/lib/$triplet/cmake" | xargs sed -i -E "s,$stated,\\1$folder/root\\2,g"
  # Debian's alternatives, which the packages' scripts would set.
  ln -s blas/libblas.so.3 lapack/liblapack.so.3 "$part/usr/lib/$triplet"
  rm -rf "$folder/apt"
  mv "$part" "$folder/root"
}

write_toolchain() {
  cat <<EOF
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_SYSROOT $1/root)
set(CMAKE_C_COMPILER $triplet-gcc)
set(CMAKE_CXX_COMPILER $triplet-g++)
set(CMAKE_Fortran_COMPILER $triplet-gfortran)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_\${kind} ONLY)
endforeach()
set(MPI_C_COMPILER $1/bin/mpicc)
set(MPI_CXX_COMPILER $1/bin/mpicxx)
set(MPI_Fortran_COMPILER $1/bin/mpifort)
# The Python of this system cannot load modules for ARM.
set(CMAKE_DISABLE_FIND_PACKAGE_nanobind ON)
EOF
}

# write_tools FOLDER: tests that call compilers or ldd by their short names get these, which know ARM. mpiexec is this system's.
write_tools() {
  local bin=$1/bin libraries=$1/root/usr/lib/$triplet name compiler
  rm -rf "$bin"
  mkdir -p "$bin"
  for name in gcc g++ gfortran; do ln -s "/usr/bin/$triplet-$name" "$bin/$name"; done
  ln -s gcc "$bin/cc"
  ln -s g++ "$bin/c++"
  while read -r name compiler; do
    cat >"$bin/$name" <<EOF
#!/bin/sh
export $compiler OPAL_LIBDIR=$libraries/openmpi/lib OPAL_INCLUDEDIR=$libraries/openmpi/include
exec $name.openmpi "\$@"
EOF
  done <<EOF
mpicc OMPI_CC=$triplet-gcc
mpicxx OMPI_CXX=$triplet-g++
mpifort OMPI_FC=$triplet-gfortran
EOF
  cat >"$bin/ldd" <<'EOF'
#!/bin/sh
for file; do LD_TRACE_LOADED_OBJECTS=1 /usr/lib/ld-linux-aarch64.so.1 "$file" || exit; done
EOF
  chmod +x "$bin"/{ldd,mpicc,mpicxx,mpifort}
}

build() {
  local source=$1 folder=$2
  write_tools "$folder"
  write_toolchain "$folder" >"$folder/toolchain.new"
  cmp -s "$folder/toolchain.new" "$folder/toolchain.cmake" || mv "$folder/toolchain.new" "$folder/toolchain.cmake"
  cd "$source"
  cmake --preset test -B "$folder/build" -D CMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake"
  cmake --build "$folder/build" --parallel "$(nproc)"
}

# run_tests SOURCE FOLDER [WORD...]: PRoot shows the tests ARM's libraries where they stand in a Debian for ARM, and starts each
# program for ARM by the emulator, also if a script or another such program calls it. Programs of this system run as usual.
run_tests() {
  local source=$1 folder=$2 select=(-LE slow) libraries=/usr/lib/$triplet status=0 start=$SECONDS
  shift 2
  (($# == 0)) || select=(-R "$(IFS='|' && echo "$*")")
  cd "$folder/build"
  rm -f "$folder/results.xml"
  # Threads that wait would otherwise take the processors from the threads that compute. Mesa draws without LLVM, whose machine
  # code crashes in the emulator. Rarely, qemu 7.2 waits for its own locks for ever. Such a test reaches its time limit, and then
  # runs again.
  env PATH="$folder/bin:$PATH" OMP_WAIT_POLICY=passive GALLIUM_DRIVER=softpipe CMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" \
    PKG_CONFIG_SYSROOT_DIR="$folder/root" PKG_CONFIG_LIBDIR="$folder/root$libraries/pkgconfig:$folder/root/usr/share/pkgconfig" \
    python3 -B "$source/tests/debian/older_calls.py" proot -q qemu-aarch64-static -r / -w "$folder/build" \
    -b "$folder/root$libraries:$libraries" -b "$folder/root/usr/lib/ld-linux-aarch64.so.1:/usr/lib/ld-linux-aarch64.so.1" \
    ctest --parallel "$(nproc)" --timeout 6000 --repeat after-timeout:2 --output-on-failure --test-output-size-passed 1000000 \
    --output-junit "$folder/results.xml" "${select[@]}" || status=$?
  python3 -B "$source/tests/debian/judge_arm64.py" "$folder/results.xml" "$source/tests/debian/arm64_skipped.txt" || status=$?
  echo "arm64: $((SECONDS - start)) seconds under the emulator"
  return "$status"
}

case ${1:-}/$# in
  root/2) make_root "$(realpath -m -- "$2")" ;;
  build/3) build "$2" "$(realpath -m -- "$3")" ;;
  test/[3-9]*) run_tests "$2" "$(realpath -m -- "$3")" "${@:4}" ;;
  *)
    echo "usage: tests/debian/arm64.sh root FOLDER | build SOURCE FOLDER | test SOURCE FOLDER [WORD...]" >&2
    exit 2
    ;;
esac

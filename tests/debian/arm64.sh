#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# arm64.sh root FOLDER                   unpacks Debian's packages for 64-bit ARM in FOLDER/root, on the first call only
# arm64.sh build SOURCE FOLDER           compiles everything for ARM in FOLDER/build
# arm64.sh test SOURCE FOLDER [WORD...] runs the tests whose names match a WORD, or the default suite, and judges the results
# arm64.sh count SOURCE FOLDER prints the instructions of a marking, by NEON and by the portable code An emulator runs the
# programs for ARM. The emulator needs 7 to 20 times as long as a processor. apt fetches the packages and dpkg unpacks them. This
# system's packages stay as they are, and no step needs root rights.
set -euo pipefail

triplet=aarch64-linux-gnu
# The packages that the tests of ./run test need, as the lists of `run` name them, and the C and Fortran libraries.
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
  # On the system that runs this script, these folders are also links. A folder for ARM covers one of this system, so both need
  # one layout.
  for link in bin lib sbin; do ln -s "usr/$link" "$part/$link"; done
  for package in "$folder"/apt/cache/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink --no-same-owner -C "$part"
  done
  # The cross compiler follows links outside the emulated system.
  find "$part" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$part$(readlink "$link")" "$link"
  done
  # CMake does not search for a library if a package's file states its path.
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
set(CMAKE_C_COMPILER $(readlink -f "/usr/bin/$triplet-gcc"))
set(CMAKE_CXX_COMPILER $(readlink -f "/usr/bin/$triplet-g++"))
set(CMAKE_Fortran_COMPILER $(readlink -f "/usr/bin/$triplet-gfortran"))
# Some tests make packages of CMake in the build folder.
set(CMAKE_FIND_ROOT_PATH $1/build)
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

# write_tools FOLDER: writes compilers and ldd that know ARM, for tests that call them by their short names. mpiexec is this
# system's.
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
  # pkg-config writes ARM's root before each path, also for a riis that a test installed outside this root.
  cat >"$bin/pkg-config" <<EOF
#!/bin/sh
found=\$(/usr/bin/pkg-config "\$@") || exit
echo "\$found" | sed 's,$1/root$1/build/,$1/build/,g'
EOF
  chmod +x "$bin"/{ldd,mpicc,mpicxx,mpifort,pkg-config}
}

configure() {
  local source=$1 folder=$2
  write_tools "$folder"
  write_toolchain "$folder" >"$folder/toolchain.new"
  cmp -s "$folder/toolchain.new" "$folder/toolchain.cmake" || mv "$folder/toolchain.new" "$folder/toolchain.cmake"
  cd "$source"
  cmake --preset test -B "$folder/build" -D CMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" \
    -D RIIS_PKG_CONFIG="$folder/bin/pkg-config"
}

build() {
  configure "$1" "$2"
  cmake --build "$2/build" --parallel "$(nproc)"
}

# instructions FOLDER PROGRAM STEPS prints the number of instructions that the program executed, and the line that the program
# prints. The emulator lists each block of instructions when it first meets the block. Later the emulator writes a line for each
# execution of the block.
instructions() {
  local libraries=$1/root/usr/lib/$triplet
  qemu-aarch64-static -L "$1/root" -E LD_LIBRARY_PATH="$libraries" -d in_asm,nochain,exec -D /dev/stdout \
    "$1/build/tests/$2" "$3" | awk '
    /^Trace/ { split($0, part, "/"); n += length_of[part[2]]; next }
    /^IN:/ { is_first = 1; next }
    /^0x/ {
      if (is_first) block = sprintf("%016s", substr($1, 3, length($1) - 3))
      if (is_first) gsub(" ", "0", block)
      length_of[block] = is_first ? 1 : length_of[block] + 1
      is_first = 0
    }
    /marked/ { marked = $0 }
    END { printf "%d %s\n", n, marked }'
}

# count SOURCE FOLDER: takes the difference of 5 and 3 markings, which excludes the start, the first marking and its preparation.
count() {
  local folder=$2 program n_few n_many few many marked=
  local -A of_marking
  configure "$1" "$folder" >/dev/null
  cmake --build "$folder/build" --parallel "$(nproc)" --target count_markings count_markings_portable >/dev/null
  for program in count_markings_portable count_markings; do
    read -r n_few few < <(instructions "$folder" "$program" 3)
    read -r n_many many < <(instructions "$folder" "$program" 5)
    if [[ -z $few || $few != "$many" || $few != "${marked:=$few}" ]]; then
      echo "arm64: other marks: '$marked', '$few', '$many'" >&2
      return 1
    fi
    of_marking[$program]=$(((n_many - n_few) / 2))
  done
  awk -v portable="${of_marking[count_markings_portable]}" -v neon="${of_marking[count_markings]}" -v marked="$marked" 'BEGIN {
    printf "%s by both\n", marked
    printf "portable code  %.2f million instructions a marking\n", portable / 1e6
    printf "NEON           %.2f million, %.1f %% fewer\n", neon / 1e6, 100 * (1 - neon / portable)
  }'
}

# run_tests SOURCE FOLDER [WORD...]: PRoot shows the tests ARM's libraries at the places that a Debian for ARM has. PRoot starts
# each program for ARM by the emulator, even if a script or another such program calls it. Programs of this system run as usual.
run_tests() {
  local source=$1 folder=$2 select=(-LE slow) libraries=/usr/lib/$triplet status=0 start=$SECONDS
  shift 2
  (($# == 0)) || select=(-R "$(IFS='|' && echo "$*")")
  cd "$folder/build"
  rm -f "$folder/results.xml"
  # Random tests make few trials, because same_bits compares all results with those of other processors. If one process starts
  # several programs by posix_spawn at once, they crash under PRoot. Ninja therefore starts one compiler at a time. Without this
  # setting of OpenMP, threads that wait would take the processors from threads that compute. Mesa draws without LLVM, whose
  # machine code crashes in the emulator. Rarely, qemu 7.2 waits for its own locks for ever. A test that waits for such a lock
  # reaches its time limit, and runs again.
  env PATH="$folder/bin:$PATH" CMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" \
    RIIS_TEST_SHORT=1 CMAKE_BUILD_PARALLEL_LEVEL=1 OMP_WAIT_POLICY=passive GALLIUM_DRIVER=softpipe \
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
  count/3) count "$2" "$(realpath -m -- "$3")" ;;
  test/[3-9] | test/[1-9][0-9]*) run_tests "$2" "$(realpath -m -- "$3")" "${@:4}" ;;
  *)
    echo "usage: tests/debian/arm64.sh root FOLDER | build SOURCE FOLDER | count SOURCE FOLDER |" \
      "test SOURCE FOLDER [WORD...]" >&2
    exit 2
    ;;
esac

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# embree.sh source FOLDER           downloads Embree's sources from the distribution's source package into FOLDER, unless a person
#                                   has put sources there
# embree.sh build SOURCE PREFIX     builds from SOURCE a static Embree for the wheel, and installs it to PREFIX
# embree.sh cost PREFIX BUILD       compares the costs of queries and updates with the system's Embree and with that in PREFIX.
#                                   The folder BUILD has a shared libriis, whose objects are linked again
# embree.sh cost isa=sse2 BUILD the same, with the system's Embree restricted to these instructions instead of the Embree in
# PREFIX
#
# riis calls Embree only to find the groups of triangles near a point. riis itself computes the bounds of these groups. In
# Embree's terms, the groups are user geometry, and the searches are point queries. The wheel's Embree therefore contains no
# triangles, quads, grids, curves, points and instances, no packets of rays, no filters and no ISPC. The marks are the same,
# because riis decides them in double precision.
set -euo pipefail

give_up() {
  echo "embree.sh: $*" >&2
  exit 1
}

# fetch_source FOLDER: the distribution's patches are left out, because they only concern its own package. The package
# libembree-dev has the licences.
fetch_source() {
  local folder licences=/usr/share/doc/libembree-dev/copyright
  folder=$(realpath -m -- "$1")
  [[ -f $licences ]] || give_up "there is no $licences: install libembree-dev"
  if [[ -f $folder/CMakeLists.txt && ! -e $folder/package ]]; then
    echo "embree.sh: takes the sources in $folder"
  else
    "$(dirname -- "$(readlink -f -- "$0")")/../packaging/apt_fetch.sh" source libembree-dev "$folder"
  fi
  cp "$licences" "$folder/copyright"
}

build() {
  local source=$1 prefix options kind
  prefix=$(realpath -m -- "$2")
  [[ -f $source/CMakeLists.txt ]] || give_up "$source is not a folder with Embree's sources"
  options=(-D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX="$prefix" -D CMAKE_INSTALL_LIBDIR=lib
    -D CMAKE_POSITION_INDEPENDENT_CODE=ON -D EMBREE_STATIC_LIB=ON -D EMBREE_ISPC_SUPPORT=OFF -D EMBREE_TUTORIALS=OFF
    -D EMBREE_SYCL_SUPPORT=OFF -D EMBREE_TASKING_SYSTEM=TBB
    # Only the baseline instructions of x86-64. Further instruction sets would double the size. riis itself searches most meshes,
    # with AVX2 or AVX-512. For ARM, Embree uses NEON, which every ARM processor has, and these options have no effect.
    -D EMBREE_MAX_ISA=NONE -D EMBREE_ISA_SSE2=ON -D EMBREE_ISA_SSE42=OFF -D EMBREE_ISA_AVX=OFF -D EMBREE_ISA_AVX2=OFF
    -D EMBREE_ISA_AVX512=OFF
    -D EMBREE_GEOMETRY_USER=ON -D EMBREE_RAY_PACKETS=OFF -D EMBREE_RAY_MASK=OFF -D EMBREE_FILTER_FUNCTION=OFF)
  for kind in TRIANGLE QUAD CURVE SUBDIVISION INSTANCE INSTANCE_ARRAY GRID POINT; do
    options+=(-D "EMBREE_GEOMETRY_$kind=OFF")
  done
  rm -rf "$prefix"
  # The installation of a static Embree expects that Embree also built TBB. Here TBB is installed already.
  : >"$source/common/cmake/installTBB.cmake"
  # Debian's sources lack the manual, which the installation copies.
  [[ -e $source/readme.pdf ]] || : >"$source/readme.pdf"
  # Without curves, nothing refers to the files of curves, which would take most of the time.
  sed -i '/curve_intersector_virtual\|bvh_builder_hair/d' "$source/kernels/CMakeLists.txt"
  cmake -S "$source" -B "$prefix.build" -G Ninja "${options[@]}" \
    -D CMAKE_CXX_FLAGS='-fvisibility=hidden -ffunction-sections -fdata-sections'
  cmake --build "$prefix.build" --parallel "$(nproc)"
  cmake --install "$prefix.build"
  # The licences of everything in this Embree, for the wheel.
  mkdir -p "$prefix/licences"
  cp "$source/copyright" "$prefix/licences/libembree.copyright"
  rm -rf "$prefix.build"
}

cost() {
  local library=$2/src/riis/libriis.so root work objects=() embree=()
  root=$(dirname -- "$(readlink -f -- "$0")")/..
  [[ -f $library ]] || give_up "there is no $library: build the target riis there"
  work=$(mktemp -d)
  mapfile -t objects < <(find "$2/src/riis/CMakeFiles" -name '*.o')
  if [[ $1 == isa=* ]]; then
    printf '%s\n' 'void *__real_rtcNewDevice(const char *);' \
      "void *__wrap_rtcNewDevice(const char *) { return __real_rtcNewDevice(\"$1\"); }" |
      sed 's/^void/extern "C" &/' | c++ -x c++ -fPIC -c - -o "$work/device.o"
    embree=("$work/device.o" "-Wl,--wrap=rtcNewDevice" "$(objdump -p "$library" | sed -n 's/^ *NEEDED *\(libembree.*\)/-l:\1/p')")
  else
    embree=("-Wl,--start-group" "$1"/lib/*.a "-Wl,--end-group")
  fi
  c++ -shared -fopenmp -Wl,--gc-sections "-Wl,--version-script=$2/src/riis/riis.map" "${objects[@]}" "${embree[@]}" \
    -ltbb -o "$work/own.so"
  cc -std=gnu11 -O2 -I "$root/include" "$root/python/tests/embree_cost.c" -o "$work/embree_cost" -lm
  "$work/embree_cost" "$(realpath -- "$library")" "$work/own.so"
  rm -rf "$work"
}

case ${1:-}/$# in
  source/2) fetch_source "$2" ;;
  build/3) build "$2" "$3" ;;
  cost/3) cost "$2" "$3" ;;
  *) give_up "usage: embree.sh source FOLDER, embree.sh build SOURCE PREFIX, or embree.sh cost PREFIX BUILD" ;;
esac

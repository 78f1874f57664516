#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# debian_root.sh build|try|wheel|program|picture VERSION: the steps of debian.sh, wheels.sh and program.sh inside a Debian of this
# version, as root.
#   build  builds the packages twice from the archive in /riis.input, compares the bytes, and checks them by lintian; leaves them
#          in out/packages
#   try    installs the packages in /riis.input, runs their tests, removes them, and looks for traces; leaves a table's lines, and
#          the marks of a program, in out/tried
#   wheel  installs the wheel in /riis.input by pip, where there is no Embree; leaves the marks of a program in out/tried
#   program  makes the archive of the program; leaves it in out/program
#   picture  unpacks this archive from /riis.input as a user without rights, marks a mesh and draws a picture; leaves the picture,
#            the numbers and the seconds in out/tried
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
input=/riis.input debian=$2
export DEBIAN_FRONTEND=noninteractive

install_packages() { logged install apt-get install -y --no-install-recommends "$@"; }

# unpack FOLDER: unpacks the archive into the folder, with Debian's folder in it. The version for Debian 12 sorts before the
# version for Debian 13.
unpack() {
  local folder=$1 entry date
  mkdir -p "$folder"
  cp "$input/riis-$version.tar.xz" "$folder/riis_$version.orig.tar.xz"
  tar -xJf "$folder/riis_$version.orig.tar.xz" -C "$folder"
  cp -R --preserve=mode debian "$folder/riis-$version/debian"
  if [[ $debian == 12 ]]; then
    entry=$(sed -n "1s/^riis (\(.*\)) [a-z]*;/riis (\1~bpo12+1) bookworm-backports;/p" debian/changelog)
    date=$(date -u -R -d "$(grep -m 1 '^ -- ' debian/changelog | sed 's/.*>  //') 1 minute")
    printf '%s\n\n  * Rebuild for bookworm-backports.\n\n%s  %s\n\n' "$entry" \
      "$(grep -m 1 '^ -- ' debian/changelog | sed 's/>.*/>/')" "$date" |
      cat - debian/changelog >"$folder/riis-$version/debian/changelog"
  fi
}

# openfoam_headers FOLDER: gets the headers for riis-openfoam, once for each version of OpenFOAM.
openfoam_headers() {
  # shellcheck source=examples/openfoam/openfoam.sh
  . examples/openfoam/openfoam.sh
  [[ -e $1/with_dynamicMesh ]] || openfoam_source "$1"
}

# build_once FOLDER: unpacks the sources and runs dpkg-buildpackage, then moves everything to the folder. Both times the build has
# the same path, as in Debian, because gfortran writes the path of a source into messages. C and C++ are compiled once for both
# times; all other steps run again.
build_once() {
  rm -rf "$work/here"
  unpack "$work/here" && cd "$work/here/riis-$version" || return
  CCACHE_DIR=$work/ccache CCACHE_BASEDIR=$work/here CCACHE_NOHASHDIR=1 PATH=/usr/lib/ccache:$PATH \
    DEB_BUILD_OPTIONS="nocheck parallel=$(nproc)" DEB_BUILD_PROFILES=$profiles nice -n 5 dpkg-buildpackage -us -uc || return
  cd "$work" && mv here "$1"
}

# sums: prints the checksums of the files that must be the same. The other files describe the machine.
sums() { (cd "$1" && sha256sum ./*.deb ./*.dsc ./*.debian.tar.xz); }

build() {
  work=$PWD/build-deb logs=$PWD/build-deb/logs profiles=pkg.riis.openfoam
  version=$(echo "$input"/riis-*.tar.xz | sed 's/.*riis-\(.*\)\.tar\.xz/\1/')
  [[ $debian != 12 ]] || profiles+=" nopython" # Debian 12 has no nanobind
  rm -rf "$work/1" "$work/2" "$work/here" "$logs" out/packages
  mkdir -p "$logs" out/packages
  logged update apt-get update
  install_packages dpkg-dev debhelper lintian ccache
  unpack "$work/here"
  logged build-dependencies apt-get build-dep -y --no-install-recommends -P "${profiles// /,}" "$work/here/riis-$version"
  # shellcheck disable=SC2016 # dpkg-query's own variable
  OPENFOAM_SOURCE=$work/openfoam-$(dpkg-query -W -f='${Version}' libopenfoam)/src
  export OPENFOAM_SOURCE
  logged openfoam-headers openfoam_headers "${OPENFOAM_SOURCE%/src}"
  (umask 022 && TZ=UTC0 LC_ALL=C.UTF-8 && export TZ LC_ALL && logged build build_once "$work/1")
  find "$work/1" -maxdepth 1 -type f -exec cp -- {} out/packages \;
  # No bug is closed before a person has filed the intent to package (docs/releasing.md).
  logged lintian lintian --allow-root --no-cfg --show-overrides --tag-display-limit 0 --fail-on error,warning \
    --suppress-tags initial-upload-closes-no-bugs "$work"/1/riis_*.changes
  cp "$logs/lintian.log" out/packages/lintian.txt
  (umask 027 && TZ=XYZ-13 LC_ALL=C && export TZ LC_ALL && logged build-again build_once "$work/2")
  diff <(sums "$work/1") <(sums "$work/2") || { echo "the second build has other bytes" >&2; exit 1; }
  say "built twice with the same bytes"
  rm -rf "$work/2"
}

# strip_root: removes the packages that the bare root did not have.
strip_root() {
  local list=/var/lib/riis-bare-packages others
  [[ -e $list ]] || installed >"$list"
  mapfile -t others < <(installed | comm -13 "$list" -)
  ((${#others[@]} == 0)) || apt-get purge -y --allow-remove-essential "${others[@]}"
}
installed() { dpkg-query -W -f='${binary:Package}\n' | LC_ALL=C sort; }

# tests_of PACKAGE: prints the tests that use the package.
tests_of() {
  case $1 in
    libriis1) echo bits pkg-config ;;
    libriis-dev) echo pkg-config cmake bits ;;
    libriis-fortran-dev) echo fortran cmake bits ;;
    libriis-vtk*) echo cmake ;;
    python3-riis) echo python ;;
    riis) echo program ;;
    riis-openfoam) echo openfoam ;;
    riis-doc) echo doc ;;
  esac
}

try() {
  local out=$PWD/out/tried tree=/tmp/riis-tree deb name packages=() debs=() others test passed
  rows=$out/rows.tsv
  logs=$PWD/out/tried/logs
  rm -rf "$out" "$tree"
  mkdir -p "$logs"
  logged update apt-get update
  logged strip-before strip_root
  for deb in "$input"/*.deb; do
    [[ $deb != *-dbgsym_* ]] || continue
    debs+=("$deb") packages+=("$(dpkg-deb -f "$deb" Package)")
  done
  # riis-openfoam needs all of OpenFOAM, so the other packages come first.
  mapfile -t others < <(printf '%s\n' "${debs[@]}" | grep -v '/riis-openfoam_')
  logged install-riis apt-get install -y --no-install-recommends "${others[@]}"
  install_packages openfoam openmpi-bin
  logged install-plug-in apt-get install -y --no-install-recommends "${debs[@]}"
  dpkg -L "${packages[@]}" | grep -v '^$' | LC_ALL=C sort -u >"$out/files.txt"
  install_packages autopkgtest dpkg-dev
  logged source dpkg-source -x "$input"/riis_*.dsc "$tree"
  local status=0
  nice autopkgtest --no-built-binaries --output-dir "$out/autopkgtest" "$tree" -- null >"$logs/tests.log" 2>&1 </dev/null ||
    status=$?
  cat "$out/autopkgtest/summary"
  # 2: a test was skipped. Debian 12 has no python3-riis, so its test is skipped there.
  ((status == 0 || (status == 2 && debian == 12))) || { tail -n 60 "$logs/tests.log" >&2 && exit 1; }
  find "$out/autopkgtest" -name marks.txt -exec cp -- {} "$out/marks.txt" \;
  for name in "${packages[@]}"; do
    deb=$(echo "$input/${name}"_*.deb) passed=
    for test in $(tests_of "$name"); do
      grep -q -E "^$test +PASS" "$out/autopkgtest/summary" || { echo "$name: its test $test did not pass" >&2; exit 1; }
      passed+="${passed:+, }$test"
    done
    [[ $passed ]] || { echo "$name: no test uses it" >&2; exit 1; }
    row "Debian $debian $name" "twice, same bytes" "bare, and removed" "$passed" "$(size "$deb")"
  done
  logged purge apt-get purge -y "${packages[@]}"
  logged strip-after strip_root
  look_for_traces "$out/files.txt"
  say "installed, tested and removed without a trace: ${packages[*]}"
}

# look_for_traces FILE: fails if a file that the list names is left, or any file with riis in its name.
look_for_traces() {
  local path left=()
  while IFS= read -r path; do
    [[ ! -e $path || -d $path ]] || left+=("$path")
  done <"$1"
  mapfile -t -O "${#left[@]}" left < <(find / -xdev \( -path /riis -o -path /riis.input -o -path /tmp -o -path /var/cache/apt \
    -o -path /var/log -o -path /proc -o -path /sys -o -path /dev \) -prune -o -name '*riis*' ! -name riis-bare-packages -print)
  ! dpkg-query -W -f='${Package} ${db:Status-Status}\n' '*riis*' 2>/dev/null | grep . || left+=("dpkg knows it")
  diff /var/lib/riis-bare-packages <(installed) || left+=("other packages")
  ((${#left[@]} == 0)) || { printf 'left after removal: %s\n' "${left[@]}" >&2; exit 1; }
}

wheel() {
  local out=$PWD/out/tried venv=/tmp/riis-wheel
  declare -A wheels=([12]=cp311-cp311 [13]=cp312-abi3)
  logs=$PWD/out/tried/logs
  rm -rf "$out" "$venv"
  mkdir -p "$logs"
  logged update apt-get update
  logged strip-before strip_root
  install_packages python3-venv
  ! find / -xdev -name 'libembree*' -not -path '/var/*' | grep . || { echo "this Debian has an Embree" >&2; exit 1; }
  python3 -m venv "$venv"
  logged pip "$venv/bin/pip" install "$input"/riis-*-"${wheels[$debian]}"-*.whl
  "$venv/bin/python" -B tests/install/stranger/marks.py >"$out/marks.txt"
  rm -rf "$venv"
  logged strip-after strip_root
}

# Packages of Debian 12 from which relocatable.sh makes the archive.
program_packages=(g++ cmake ninja-build pkg-config python3 xz-utils patchelf libvtk9-dev libx11-dev libcli11-dev
  nlohmann-json3-dev libhdf5-dev libembree-dev libtbb-dev xvfb x11-xkb-utils xkb-data libgl1-mesa-dri meson bison flex
  python3-mako libxext-dev libxcb-randr0-dev libxrandr-dev libexpat1-dev zlib1g-dev)

program() {
  logs=$PWD/out/program/logs
  rm -rf out/program
  mkdir -p "$logs"
  logged update apt-get update
  install_packages "${program_packages[@]}"
  packaging/relocatable.sh out/program
}

picture() {
  local out=$PWD/out/tried home=/tmp/riis-picture as_user=(setpriv --reuid 1234 --regid 1234 --clear-groups env -i) start=$SECONDS
  logs=$PWD/out/tried/logs
  rm -rf "$out" "$home"
  mkdir -p "$logs" "$home"
  logged update apt-get update
  logged strip-before strip_root
  install_packages xz-utils
  chown 1234:1234 "$home"
  # A box of hexahedra round the valve. The bare system has nothing that makes meshes.
  awk -v n=36 'BEGIN {
    print "# vtk DataFile Version 3.0\na box\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS", n ^ 3, "double"
    for (i = 0; i < n ^ 3; ++i) print -1.75 + 0.1 * (i % n), -1.75 + 0.1 * (int(i / n) % n), -1.75 + 0.1 * int(i / n ^ 2)
    m = n - 1
    print "CELLS", m ^ 3, 9 * m ^ 3
    for (z = 0; z < m; ++z) for (y = 0; y < m; ++y) for (x = 0; x < m; ++x) {
      a = x + n * (y + n * z)
      print 8, a, a + 1, a + 1 + n, a + n, a + n ^ 2, a + 1 + n ^ 2, a + 1 + n + n ^ 2, a + n + n ^ 2
    }
    print "CELL_TYPES", m ^ 3
    for (i = 0; i < m ^ 3; ++i) print 12
  }' >"$home/box.vtk"
  logged unpack "${as_user[@]}" PATH="$PATH" tar -xJf "$input"/riis-*-linux-"$(uname -m)".tar.xz -C "$home"
  logged mark "${as_user[@]}" PATH=/usr/bin:/bin HOME="$home" sh -c "cd $home && riis-*/bin/riis mark box.vtk --unit cm \
    --valve coapting --opening 0.5 --output marked.vtu --stats stats.json --picture picture.png"
  echo "$((SECONDS - start))" >"$out/seconds.txt"
  # A bare system has no pgrep.
  [[ -d /proc/1 ]] || { echo "/proc does not show processes" >&2; exit 1; }
  [[ ! $(find /proc -maxdepth 1 -user 1234 2>/dev/null) ]] || { echo "a process is left" >&2; exit 1; }
  # With the leaflets and the marked cells the picture has 112 kB, and without them 48 kB.
  (($(stat -c %s "$home/picture.png") > 80000)) || { echo "the picture lacks the valve or its marks" >&2; exit 1; }
  grep -E '"n_(nodes|marked|triangles)"' "$home/stats.json" >"$out/numbers.txt"
  cp "$home/picture.png" "$out"
  rm -rf "$home"
  logged strip-after strip_root
}

case $1 in
  build) build ;;
  try) try ;;
  wheel) wheel ;;
  program) program ;;
  picture) picture ;;
  *)
    echo "debian_root.sh: '$1' is not build, try, wheel, program or picture" >&2
    exit 2
    ;;
esac

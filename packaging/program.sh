#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program.sh ROWS: makes the archive of the program in a Debian 12 (relocatable.sh). Unpacks it in a bare Debian 12 and in a bare
# Debian 13, as a user without rights and without a display, marks a mesh there and draws a picture. Leaves the archive and the
# pictures in out/packages/program. Appends a line for each Debian to the file ROWS.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
[[ $# == 1 ]] || { echo "usage: packaging/program.sh ROWS" >&2; exit 2; }
rows=$(realpath -m -- "$1") roots=${RIIS_ROOTS:-$PWD} out=$PWD/out/packages/program
declare -A suites=([12]=bookworm [13]=trixie)

inside() { RIIS_ROOT_INPUT=$out tests/debian/in_root.sh "${suites[$1]}" "$roots/$2$1" packages inside "${@:3}"; }

rm -rf "$out"
mkdir -p "$out"
say "Debian 12: the program with its libraries"
inside 12 build-debian program 12
cp "$roots"/build-debian12/root/riis/out/program/riis-*.tar.xz "$out"
archive=$(echo "$out"/riis-*.tar.xz)
for debian in 12 13; do
  say "Debian $debian: marks and a picture without a compiler, without root and without a display"
  inside "$debian" build-bare picture "$debian"
  cp "$roots/build-bare$debian/root/riis/out/tried/picture.png" "$out/picture$debian.png"
  cp "$roots/build-bare$debian/root/riis/out/tried/numbers.txt" "$out/numbers$debian.txt"
  cmp "$out/numbers12.txt" "$out/numbers$debian.txt" || { echo "program.sh: other marks in Debian $debian" >&2; exit 1; }
  row "$(basename "$archive" .tar.xz)" "in Debian 12" "bare Debian $debian, unpacked" \
    "marks and a picture in $(cat "$roots/build-bare$debian/root/riis/out/tried/seconds.txt") s" "$(size "$archive")"
done

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# debian.sh ROWS [12] [13]: builds Debian's packages of the last commit in a Debian of each version, twice with the same bytes.
# Installs them in a bare Debian, tests what was installed, and removes it again. Leaves the packages in out/packages. Appends a
# line for each package to the file ROWS.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
(($# > 0)) || { echo "usage: packaging/debian.sh ROWS [12] [13]" >&2; exit 2; }
rows=$(realpath -m -- "$1")
shift
(($# > 0)) || set -- 12 13
for debian in "$@"; do
  [[ $debian == 1[23] ]] || { echo "debian.sh: '$debian' is not a version of Debian, 12 or 13" >&2; exit 2; }
done
roots=${RIIS_ROOTS:-$PWD} input=$PWD/build/packages
declare -A suites=([12]=bookworm [13]=trixie)

inside() { tests/debian/in_root.sh "${suites[$1]}" "$roots/$2$1" packages inside "${@:3}"; }

packaging/dist.sh archive
rm -rf "$input"
mkdir -p "$input"
cp out/dist/riis-*.tar.xz "$input"
for debian in "$@"; do
  out=$PWD/out/packages/debian$debian
  say "Debian $debian: build"
  RIIS_ROOT_INPUT=$input inside "$debian" build-debian build "$debian"
  rm -rf "$out"
  mkdir -p "$out"
  cp -R "$roots/build-debian$debian/root/riis/out/packages/." "$out"
  say "Debian $debian: install, test, remove"
  RIIS_ROOT_INPUT=$out inside "$debian" build-bare "try" "$debian"
  cp -R "$roots/build-bare$debian/root/riis/out/tried/." "$out"
  same_marks "debian$debian" "$out/marks.txt"
  cat "$out/rows.tsv" >>"$rows"
done

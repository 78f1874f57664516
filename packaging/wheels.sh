#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# wheels.sh ROWS [12] [13]: makes Python's wheel with its own Embree in a Debian of each version, and runs all tests and the type
# checkers there (./run python tests). Installs the wheel by pip in a bare Debian, which has no Embree, and marks there. Leaves
# the wheels in out/packages. Appends a line for each wheel to the file ROWS.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
(($# > 0)) || { echo "usage: packaging/wheels.sh ROWS [12] [13]" >&2; exit 2; }
rows=$(realpath -m -- "$1") roots=${RIIS_ROOTS:-$PWD}
shift
(($# > 0)) || set -- 12 13
declare -A suites=([12]=bookworm [13]=trixie)
for debian in "$@"; do
  [[ ${suites[$debian]:-} ]] || { echo "wheels.sh: '$debian' is not a version of Debian, 12 or 13" >&2; exit 2; }
done
for debian in "$@"; do
  out=$PWD/out/packages/wheel$debian
  say "Debian $debian: the wheel"
  tests/debian/in_root.sh "${suites[$debian]}" "$roots/build-debian$debian" python tests
  rm -rf "$out"
  mkdir -p "$out"
  cp "$roots/build-debian$debian"/root/riis/build-python/repaired/riis-*.whl "$out"
  say "Debian $debian: install it where there is no Embree"
  RIIS_ROOT_INPUT=$out tests/debian/in_root.sh "${suites[$debian]}" "$roots/build-bare$debian" packages inside wheel "$debian"
  cp "$roots/build-bare$debian/root/riis/out/tried/marks.txt" "$out"
  same_marks "wheel$debian" "$out/marks.txt"
  wheel=$(echo "$out"/riis-*.whl)
  row "wheel $(basename "$wheel" .whl)" "in Debian $debian" "bare, without Embree" "tests, types, Python: same bits" \
    "$(size "$wheel")"
done

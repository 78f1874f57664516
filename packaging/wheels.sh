#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# wheels.sh ROWS: makes both wheels of a release in a Debian 12, with their own Embree (./run python wheels). Installs each wheel
# by pip in a bare Debian, which has neither Embree nor a compiler, and marks there. Then runs all tests and the type checkers
# with the wheel for Python 3.11 in Debian 12, and with the wheel for later versions in Debian 13. Leaves the wheels in
# out/packages/wheels. Appends a line for each wheel to the file ROWS.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
[[ $# == 1 ]] || { echo "usage: packaging/wheels.sh ROWS" >&2; exit 2; }
rows=$(realpath -m -- "$1") roots=${RIIS_ROOTS:-$PWD} out=$PWD/out/packages/wheels
declare -A suites=([12]=bookworm [13]=trixie) tags=([12]=cp311-cp311 [13]=cp312-abi3)

inside() { RIIS_ROOT_INPUT=$out tests/debian/in_root.sh "${suites[$1]}" "$roots/$2$1" "${@:3}"; }

rm -rf "$out"
mkdir -p "$out"
say "Debian 12: the wheels"
inside 12 build-debian python wheels
# The C program whose marks the tests compare with the wheel's has its own Embree, as the wheels do.
cp "$roots"/build-debian12/root/riis/out/wheels/riis-*.whl \
  "$roots"/build-debian12/root/riis/build-python/cp*/python/riis_python_c_marks "$out"
for debian in 12 13; do
  say "Debian $debian: install the wheel where there is no Embree"
  inside "$debian" build-bare packages inside wheel "$debian"
  cp "$roots/build-bare$debian/root/riis/out/tried/marks.txt" "$out/marks$debian.txt"
  same_marks "wheel$debian" "$out/marks$debian.txt"
done
for debian in 12 13; do
  wheel=$(echo "$out"/riis-*-"${tags[$debian]}"-*.whl)
  say "Debian $debian: all tests with $(basename "$wheel")"
  inside "$debian" build-debian python wheel "/riis.input/$(basename "$wheel")" /riis.input/riis_python_c_marks
  row "wheel $(basename "$wheel" .whl)" "in Debian 12" "bare Debian $debian, without Embree" "tests, types, Python: same bits" \
    "$(size "$wheel")"
done
rm "$out/riis_python_c_marks"

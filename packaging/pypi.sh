#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pypi.sh ROWS: makes and tests the packages whose registries are not Debian's: Python's wheel and source distribution, fpm's
# package, and the recipes for conda and Spack and the workflows as far as they can be tested without their registries. Appends a
# line for each to the file ROWS, with tabs between: package, built, installed, tested, size. Tools come from PyPI.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
[[ $# == 1 ]] || { echo "usage: packaging/pypi.sh ROWS" >&2; exit 2; }
rows=$(realpath -m -- "$1")
work=$PWD/build-packages fresh=$PWD/build-python/fresh/bin
fpm_version=0.12.0 build_version=1.3.0 rattler_version=0.73.0 actionlint_version=v1.7.7
mkdir -p "$work"

say() { printf '==> %s\n' "$*"; }
# row PACKAGE BUILT INSTALLED TESTED SIZE
row() { (IFS=$'\t' && printf '%s\n' "$*" >>"$rows"); }
# size FILE: prints its size in kB or MB.
size() { numfmt --to=si --suffix=B --format='%.1f' "$(stat -c %s "$1")"; }
# logged NAME COMMAND...: runs the command with its output in a log, whose end it shows if the command fails.
logged() {
  local log=$work/$1.log
  shift
  "$@" >"$log" 2>&1 || { tail -n 40 "$log" >&2 && exit 1; }
}

# marks_in_python PYTHON: prints the same numbers as fpm's mark_box.f90. They must agree to the last bit.
marks_in_python() {
  "$1" - <<'PYTHON'
import numpy, riis
x = numpy.arange(-16, 17) / 8
z, y, x = (values.ravel() for values in numpy.meshgrid(x, x, x, indexing="ij"))
mesh = riis.Mesh(numpy.column_stack([x, y, z]))
marks = riis.mark(riis.Surface(riis.Valve("mitral", opening=0.5)), mesh)
print(len(marks.ids), len(mesh), *(float(value).hex() for value in (marks.distance.min(), marks.distance.max())))
PYTHON
}

say "the wheel: ./run python tests"
./run python tests
wheel=$(echo build-python/repaired/riis-*.whl)
expected=$(marks_in_python "$fresh/python")
tests=$("$fresh/python" -m pytest --collect-only -q python/tests 2>/dev/null | tail -n 1 | sed 's/ collected.*//')
row "wheel $(basename "$wheel" .whl)" yes "a fresh environment" "$tests, types, its own libraries" "$(size "$wheel")"

# ./run packages debian leaves the marks of a program that used Debian's packages.
for marks in out/packages/debian*/marks.txt; do
  [[ -e $marks ]] || continue
  "$fresh/python" -B tests/install/stranger/marks.py | cmp - "$marks" || {
    echo "pypi.sh: the wheel marks other nodes than Debian's packages ($marks)" >&2
    exit 1
  }
  say "the wheel marks the bits of $marks"
done

say "the source distribution"
[[ -x $work/tools/bin/pyproject-build ]] || {
  logged tools-venv /usr/bin/python3 -m venv "$work/tools"
  logged tools "$work/tools/bin/pip" install "build==$build_version" "fpm==$fpm_version" pyyaml \
    "py-rattler-build==$rattler_version"
}
rm -rf "$work/sdist" "$work/from-sdist"
logged sdist "$work/tools/bin/pyproject-build" --sdist --outdir "$work/sdist" .
sdist=$(echo "$work"/sdist/riis-*.tar.gz)
/usr/bin/python3 -m venv "$work/from-sdist"
logged from-sdist "$work/from-sdist/bin/pip" install "$sdist"
[[ $(cd "$work" && marks_in_python "$work/from-sdist/bin/python") == "$expected" ]] || {
  echo "pypi.sh: the package from $sdist marks other nodes than the wheel" >&2
  exit 1
}
row "sdist $(basename "$sdist")" yes "pip, the system's Embree" "the wheel's bits" "$(size "$sdist")"

say "fpm"
logged fpm-library cmake --preset library -D CMAKE_INSTALL_PREFIX="$work/riis" -D CMAKE_INSTALL_LIBDIR=lib
logged fpm-library cmake --build --preset library --parallel "$(nproc)"
logged fpm-library cmake --install build-library
rm -rf "$work/fpm"
mkdir -p "$work/fpm/examples"
cp -R fpm.toml fortran "$work/fpm"
cp -R examples/fpm "$work/fpm/examples"
found=$(cd "$work/fpm" && PATH=$work/tools/bin:$PATH FPM_LDFLAGS=-L$work/riis/lib LD_LIBRARY_PATH=$work/riis/lib \
  fpm run --profile release 2>"$work/fpm.log") || { tail -n 40 "$work/fpm.log" >&2 && exit 1; }
found=$(sed -nE 's/^([0-9]+) of ([0-9]+) nodes are marked, at *([^ ]+) to *([^ ]+) cm$/\1 \2 \3 \4/p' <<<"$found")
found=$("$fresh/python" -c 'import sys; a, b, c, d = sys.argv[1].split(); print(a, b, float(c).hex(), float(d).hex())' "$found")
[[ $found == "$expected" ]] || { echo "pypi.sh: fpm's program marks $found, and Python $expected" >&2 && exit 1; }
row "fpm riis" "fpm $fpm_version" "against an installed libriis" "the wheel's bits" "$(size fpm.toml)"

say "the recipes for conda and Spack"
archive=$work/$(sed -n 's/^version: \(.*\)/riis-\1.tar.gz/p' CITATION.cff)
tar -czf "$archive" LICENSE
/usr/bin/python3 -B packaging/recipes.py "$archive" "https://git.example/owner/riis/${archive##*/}" "$work/recipes"
logged conda "$work/tools/bin/python" -B packaging/render_conda.py "$work/recipes/conda/recipe.yaml"
row "conda recipe.yaml" "no: its registry" no "rendered by rattler-build $rattler_version" "$(size packaging/conda/recipe.yaml)"
row "Spack package.py" "no: its registry" no "parsed; options and versions fit" "$(size packaging/spack/package.py)"

say "the workflows"
logged recipes "$work/tools/bin/python" -B tests/docs/test_recipes.py
if command -v go >/dev/null; then
  [[ -x $work/go/actionlint ]] ||
    logged actionlint-build env GOBIN="$work/go" go install "github.com/rhysd/actionlint/cmd/actionlint@$actionlint_version"
  logged actionlint "$work/go/actionlint" -color=false .github/workflows/*.yml
  row "workflows" "" "" "actionlint $actionlint_version, test_recipes.py" ""
else
  row "workflows" "" "" "test_recipes.py; actionlint needs go" ""
fi

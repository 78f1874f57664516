#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pypi.sh ROWS: makes and tests the packages whose registries are not Debian's: Python's wheel and source distribution, fpm's
# package, and the recipes for conda and Spack and the workflows as far as they can be tested without their registries. Appends a
# line for each to the file ROWS. Tools come from PyPI.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
[[ $# == 1 ]] || { echo "usage: packaging/pypi.sh ROWS" >&2; exit 2; }
rows=$(realpath -m -- "$1")
work=$PWD/build-packages fresh=$PWD/build-python/fresh/bin
fpm_version=0.12.0 build_version=1.3.0 rattler_version=0.73.0 actionlint_version=v1.7.7
mkdir -p "$work"
logs=$work

# marks_in_python NAME PYTHON: the program of a stranger marks the same bits with this Python's package.
marks_in_python() {
  (cd "$work" && "$2" -B "$OLDPWD/tests/install/stranger/marks.py" >marks.txt)
  same_marks "$1" "$work/marks.txt"
}

# run_fpm FOLDER: runs the program of fpm's package in this folder, against the library in the work folder.
run_fpm() {
  (cd "$1" && PATH=$work/tools/bin:$PATH FPM_LDFLAGS=-L$work/riis/lib LD_LIBRARY_PATH=$work/riis/lib fpm run --profile release)
}

say "the wheel: ./run python tests"
./run python tests
wheel=$(echo build-python/repaired/riis-*.whl)
marks_in_python wheel "$fresh/python"
tests=$("$fresh/python" -m pytest --collect-only -q python/tests 2>/dev/null | tail -n 1 | sed 's/ collected.*//')
row "wheel $(basename "$wheel" .whl)" yes "a fresh environment" "$tests, types, its own libraries" "$(size "$wheel")"

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
marks_in_python sdist "$work/from-sdist/bin/python"
row "sdist $(basename "$sdist")" yes "pip, the system's Embree" "Python: same bits" "$(size "$sdist")"

say "fpm"
logged fpm-library cmake --preset library -D CMAKE_INSTALL_PREFIX="$work/riis" -D CMAKE_INSTALL_LIBDIR=lib
logged fpm-library cmake --build --preset library --parallel "$(nproc)"
logged fpm-library cmake --install build-library
say "the system's Embree (first) and the wheel's Embree (second)"
python/embree.sh cost build-python/embree build-library
rm -rf "$work/fpm" "$work/stranger"
mkdir -p "$work/fpm/examples" "$work/stranger/app"
cp -R fpm.toml fortran "$work/fpm"
cp -R examples/fpm "$work/fpm/examples"
logged fpm run_fpm "$work/fpm"
grep -E '^[1-9][0-9]* of 35937 nodes are marked' "$work/fpm.log" || { echo "pypi.sh: mark_box.f90 marks nothing" >&2; exit 1; }
# Another package that depends on riis.
cp tests/install/stranger/marks.f90 "$work/stranger/app/main.f90"
printf 'name = "stranger"\n[dependencies]\nriis = { path = "../fpm" }\n' >"$work/stranger/fpm.toml"
logged fpm-stranger run_fpm "$work/stranger"
grep -E '^[0-9]+ [0-9A-F]{16}$' "$work/fpm-stranger.log" >"$work/marks.txt"
same_marks fpm "$work/marks.txt"
row "fpm riis" "fpm $fpm_version" "against an installed libriis" "Fortran: same bits" "$(size fpm.toml)"

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

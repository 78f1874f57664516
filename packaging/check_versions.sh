#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_versions.sh FOLDER [VERSION]
# Prints each place of the source tree that has the version. All must be the version of riis.h, which is also VERSION if given.
# The source archive lacks debian/, so a place there may be missing if the whole folder is.
set -euo pipefail
cd "$1"
version=$(sed -n -E 's/^#define RIIS_VERSION_(MAJOR|MINOR|PATCH) ([0-9]+).*/\2/p' include/riis/riis.h | paste -s -d .)
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || { echo "include/riis/riis.h: no version" >&2; exit 1; }
status=0

# place NAME FOUND [WANTED]: the place must have the version.
place() {
  printf '%-34s %s\n' "$1" "$2"
  [[ $2 == "${3:-$version}" ]] || {
    echo "$1: the version is '$2', not ${3:-$version} as in include/riis/riis.h" >&2
    status=1
  }
}
# first FILE PATTERN: prints the first match of the group in the pattern.
first() { if [[ -e $1 ]]; then sed -n -E "s/$2/\1/p" "$1" | head -n 1; else echo "no such file"; fi; }

place include/riis/riis.h "$version"
[[ ! ${2:-} ]] || place "CMake's project()" "$2"
place CITATION.cff "$(first CITATION.cff '^version: (.*)')"
place CHANGELOG.md "$(first CHANGELOG.md '^## ([0-9.]+).*')"
# Python's build tool reads riis.h itself.
place pyproject.toml "$(first pyproject.toml '^input = "(.*)"')" include/riis/riis.h
for library in riis riis_vtk; do
  place "abi/$library-*.xml" "$(cd abi && echo "$library"-*.xml)" "$library-${version%.*}.xml"
done
[[ ! -d tests ]] || place tests/abi/CMakeLists.txt "$(first tests/abi/CMakeLists.txt '^set\(riis_release (.*)\)')" "${version%.*}"
[[ ! -d debian ]] || place debian/changelog "$(first debian/changelog '^riis \((.*)-[^-]*\) .*')"
[[ ! -e fpm.toml ]] || place fpm.toml "$(first fpm.toml '^version = "(.*)"')"
[[ ! -d packaging/conda ]] || place packaging/conda/recipe.yaml "$(first packaging/conda/recipe.yaml '^ *version: "(.*)"')"
[[ ! -d packaging/spack ]] || place packaging/spack/package.py "$(first packaging/spack/package.py '^ *version\("([^"]*)".*')"
exit $status

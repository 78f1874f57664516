#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_versions_judged.sh SOURCE_FOLDER SCRATCH_FOLDER VERSION
# All files of the sources that state the version of riis must agree. The check must refuse a wrong version in any place, and name
# the place. The check also covers the symbols files of Debian's packages.
set -euo pipefail
source=$1 scratch=$2 version=$3
"$source/packaging/check_versions.sh" "$source" "$version" >"$scratch.table" 2>"$scratch.said" ||
  { cat "$scratch.said" >&2; exit 1; }

plant() {
  local name names=(include/riis/riis.h CITATION.cff CHANGELOG.md pyproject.toml abi tests/abi/CMakeLists.txt)
  for name in debian fpm.toml packaging; do
    [[ ! -e $source/$name ]] || names+=("$name")
  done
  rm -rf "$scratch"
  mkdir -p "$scratch"
  tar -c -C "$source" "${names[@]}" | tar -x -C "$scratch"
}

# refuses NAME COMMAND...: runs the command in the copy. The check must then name the place.
refuses() {
  local name=$1
  shift
  plant
  (cd "$scratch" && "$@")
  if "$source/packaging/check_versions.sh" "$scratch" "$version" >/dev/null 2>"$scratch.said"; then
    echo "not refused: $name" >&2
    exit 1
  fi
  grep -q -F "$name: the version is" "$scratch.said" || { cat "$scratch.said" >&2; echo "no message on $name" >&2; exit 1; }
}

n=0
while read -r name found; do
  case $name in
    include/* | "CMake's") continue ;; # all places are compared with these two
    abi/*) refuses "$name" mv "abi/$found" "abi/${found%-*}-0.1.xml" ;;
    pyproject.toml) refuses "$name" sed -i "s,^input = .*,input = \"version.h\"," "$name" ;;
    *) refuses "$name" sed -i "s/${found//./\\.}/9.9.9/" "$name" ;;
  esac
  n=$((n + 1))
done <"$scratch.table"
((n >= 6)) || { echo "only $n places" >&2; exit 1; }
plant
if "$source/packaging/check_versions.sh" "$scratch" 9.9.9 >/dev/null 2>&1; then
  echo "not refused: another version of CMake's project()" >&2
  exit 1
fi

if [[ -d $source/debian ]]; then
  "$source/packaging/write_symbols.sh" "$source" check
  sed -i '/riis_mark_nodes/d' "$scratch"/debian/libriis1.symbols
  if "$source/packaging/write_symbols.sh" "$scratch" check >"$scratch.said" 2>&1; then
    echo "not refused: a symbols file that lacks a function" >&2
    exit 1
  fi
  grep -q -F 'riis_mark_nodes@RIIS_1 1.0.0' "$scratch.said"
fi
echo "$n places have the version $version"

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_floors.sh SOURCE_FOLDER
# The folders of the library, src/riis, are ordered as floors: no file may include a file of a later floor. src/riis_vtk and
# src/program use the library only by its public headers. The headers in src/common include no product's headers.
set -euo pipefail
cd "$1"
floors=(base laws parallel geometry kernels valve landmarks surface distance marking pipeline api)
failed=0 n=0

complain() {
  echo "$1" >&2
  failed=1
}

# floor_of FOLDER: prints the position of a folder of src/riis among the floors, or fails.
floor_of() {
  local i
  for i in "${!floors[@]}"; do
    [[ ${floors[i]} != "$1" ]] || { echo "$i"; return; }
  done
  echo "src/riis/$1 is no floor: check_floors.sh has the list" >&2
  return 1
}

# includes_of FOLDER: prints "FILE LINE INCLUDED" for each include. INCLUDED is the header's first folder, or the header itself if
# it has none.
includes_of() {
  grep -rnoE '^ *# *include *"[^"]+"' "$1" | sed -E 's/^([^:]*):([0-9]+):[^"]*"([^"/]+).*$/\1 \2 \3/'
}

for product in */; do
  product=${product%/}
  case $product in
    riis) continue ;;
    common) allowed=(common) ;;
    riis_vtk | program) allowed=(common "$product") ;;
    *) complain "src/$product is no product: check_floors.sh has the list"; continue ;;
  esac
  while read -r file line included; do
    n=$((n + 1))
    [[ " ${allowed[*]} " == *" $included "* ]] ||
      complain "src/$file:$line includes \"$included\", but src/$product has only ${allowed[*]} and the public headers"
  done < <(includes_of "$product")
done

for folder in riis/*/; do
  folder=$(basename "$folder")
  own=$(floor_of "$folder") || { failed=1; continue; }
  while read -r file line included; do
    n=$((n + 1))
    [[ $included != common ]] || continue
    other=$(floor_of "$included") || { failed=1; continue; }
    ((other <= own)) || complain "src/$file:$line includes src/riis/$included, a floor above src/riis/$folder"
  done < <(includes_of "riis/$folder")
done
((n > 0)) || { echo "no include was read" >&2; exit 1; }
((failed)) || echo "$n includes, none upwards"
exit $failed

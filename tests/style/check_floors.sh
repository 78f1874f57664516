#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_floors.sh SOURCE_FOLDER
# The folders of the library, src/riis, are ordered as floors: a file may not include a file of a later floor. The folders of
# src/riis_vtk are also ordered as floors. All other products use only the public headers of the library. The files in src/common
# include no headers of a product. The plug-ins may not include src/common, because users build them without the library's
# sources.
set -euo pipefail
cd "$1"
declare -A floors=(
  [riis]="base parallel geometry laws kernels valve landmarks motion triangulate arrays paper_distances scene mesh search marks
    obstacle measures pipeline seal api"
  [riis_vtk]="base read mesh surface picture")
failed=0 n=0

complain() {
  echo "$1" >&2
  failed=1
}

# floor_of PRODUCT FOLDER: sets `position` to the position of a folder among the floors of a product. Reports an unknown folder
# and fails.
floor_of() {
  local floor
  position=0
  for floor in ${floors[$1]}; do
    [[ $floor != "$2" ]] || return 0
    position=$((position + 1))
  done
  complain "src/$1/$2 is no floor: check_floors.sh has the list"
  return 1
}

# includes_of FOLDER: prints "FILE LINE INCLUDED FOLDER" for each include. INCLUDED is the header's first folder, and FOLDER the
# second. For a header without a second folder, FOLDER is the first.
includes_of() {
  grep -rnoE '^ *# *include *"[^"]+"' "$1" | sed -E 's/^([^:]*):([0-9]+):[^"]*"([^"/]+)\/?([^"/]*).*$/\1 \2 \3 \4/'
}

for product in */; do
  product=${product%/}
  case $product in
    riis) continue ;;
    common) allowed=(common) ;;
    riis_vtk | program) allowed=(common "$product") ;;
    openfoam | paraview) allowed=() ;;
    *) complain "src/$product is no product: check_floors.sh has the list"; continue ;;
  esac
  while read -r file line included _; do
    n=$((n + 1))
    if ((${#allowed[@]} == 0)); then
      [[ ! -d $included && ! -d riis/$included && $included != .. ]] ||
        complain "src/$file:$line includes \"$included\", but src/$product has only its own and the public headers"
    elif [[ " ${allowed[*]} " != *" $included "* ]]; then
      complain "src/$file:$line includes \"$included\", but src/$product has only ${allowed[*]} and the public headers"
    fi
  done < <(includes_of "$product")
done

# check_floors PRODUCT: checks the includes of the product's floors. Paths of riis begin with the floor, and paths of riis_vtk
# with the product.
check_floors() {
  local folder own position file line first second included
  for folder in "$1"/*/; do
    folder=$(basename "$folder")
    floor_of "$1" "$folder" || continue
    own=$position
    while read -r file line first second; do
      n=$((n + 1))
      [[ $first != common ]] || continue
      included=$first
      [[ $1 == riis ]] || included=$second
      floor_of "$1" "$included" || continue
      ((position <= own)) || complain "src/$file:$line includes src/$1/$included, a floor above src/$1/$folder"
    done < <(includes_of "$1/$folder")
  done
}
check_floors riis
check_floors riis_vtk
((n > 0)) || { echo "no include was read" >&2; exit 1; }
((failed)) || echo "$n includes, none upwards"
exit $failed

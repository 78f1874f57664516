#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_floors.sh SOURCE_FOLDER
# The library's folders are floors, each built on the earlier ones. No file may include a file of a later floor. The component vtk
# and the program cli stand beside them, on the public headers: of the library's own folders they may include base.
set -euo pipefail
cd "$1"
floors=(base laws parallel geometry kernels valve surface distance marking pipeline api)

floor_of() {
  local i
  for i in "${!floors[@]}"; do
    [[ ${floors[i]} != "$1" ]] || { echo "$i"; return; }
  done
  echo "src/$1 is no floor: check_floors.sh has the list" >&2
  return 1
}

failed=0 n=0
for folder in */; do
  folder=${folder%/}
  case $folder in
    vtk | cli) own= ;;
    *) own=$(floor_of "$folder") || { failed=1; continue; } ;;
  esac
  while IFS=: read -r file line included; do
    if [[ ! $own ]]; then
      n=$((n + 1))
      if [[ $included != "$folder" && $included != base ]]; then
        echo "src/$file:$line includes src/$included, but src/$folder has only base and the public headers" >&2
        failed=1
      fi
      continue
    fi
    other=$(floor_of "$included") || { failed=1; continue; }
    n=$((n + 1))
    if ((other > own)); then
      echo "src/$file:$line includes src/$included, a floor above src/$folder" >&2
      failed=1
    fi
  done < <(grep -rnoE '^ *# *include *"[a-z_]+/' "$folder" | sed -E 's/^([^:]*):([0-9]+):.*"([a-z_]+)\/$/\1:\2:\3/')
done
((n > 0)) || { echo "no include was read" >&2; exit 1; }
((failed)) || echo "$n includes, none upwards"
exit $failed

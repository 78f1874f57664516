#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_floors_judged.sh SOURCE_FOLDER SCRATCH_FOLDER
# check_floors.sh must accept the library, and refuse an include upwards, a folder that is no floor, and a part of the library
# that the component or the program includes past the public headers.
set -euo pipefail
check=$(dirname "$0")/check_floors.sh
sources=$1 scratch=$2

# refuses MESSAGE: the check must fail on the scratch copy with this message.
refuses() {
  local said
  if said=$("$check" "$scratch" 2>&1); then
    echo "not refused: $1" >&2
    exit 1
  fi
  [[ $said == *"$1"* ]] || { echo "'$said' lacks '$1'" >&2; exit 1; }
}

copy() {
  rm -rf "$scratch"
  cp -r "$sources" "$scratch"
}

copy
"$check" "$scratch"
echo '#include "api/handles.hpp"' >>"$scratch/geometry/vec3.hpp"
refuses "includes src/api, a floor above src/geometry"
copy
mkdir "$scratch/cellar"
refuses "src/cellar is no floor"
copy
echo '#include "cellar/wine.hpp"' >>"$scratch/base/log.hpp"
refuses "src/cellar is no floor"
copy
echo '#include "marking/mesh.hpp"' >>"$scratch/cli/report.hpp"
refuses "includes src/marking, but src/cli has only base and the public headers"
copy
echo '#include "cli/report.hpp"' >>"$scratch/vtk/files.hpp"
refuses "includes src/cli, but src/vtk has only base and the public headers"
rm -rf "$scratch"

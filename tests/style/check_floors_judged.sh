#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_floors_judged.sh SOURCE_FOLDER SCRATCH_FOLDER
# check_floors.sh must accept the library. The script must refuse an include of a later floor, a folder that is not in the plan,
# and an include of the library's internals by another product.
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
echo '#include "api/handles.hpp"' >>"$scratch/riis/geometry/vec3.hpp"
refuses "includes src/riis/api, a floor above src/riis/geometry"
copy
mkdir "$scratch/riis/cellar"
refuses "src/riis/cellar is no floor"
copy
echo '#include "cellar/wine.hpp"' >>"$scratch/riis/base/log.hpp"
refuses "src/riis/cellar is no floor"
copy
mkdir "$scratch/cellar"
refuses "src/cellar is no product"
copy
echo '#include "mesh/mesh.hpp"' >>"$scratch/program/report.hpp"
refuses 'includes "mesh", but src/program has only common program and the public headers'
copy
echo '#include "../riis/mesh/mesh.hpp"' >>"$scratch/program/report.hpp"
refuses 'includes "..", but src/program has only common program'
copy
echo '#include "program/output/report.hpp"' >>"$scratch/riis_vtk/files.hpp"
refuses 'includes "program", but src/riis_vtk has only common riis_vtk and the public headers'
copy
echo '#include "riis_vtk/base/files.hpp"' >>"$scratch/riis/api/handles.hpp"
refuses "src/riis/riis_vtk is no floor"
copy
echo '#include "base/errors.hpp"' >>"$scratch/common/message.hpp"
refuses 'includes "base", but src/common has only common'
copy
echo '#include "riis_vtk/picture/drawing.hpp"' >>"$scratch/riis_vtk/read/gmsh.cpp"
refuses "includes src/riis_vtk/picture, a floor above src/riis_vtk/read"
copy
echo '#include "mesh/mesh.hpp"' >>"$scratch/openfoam/riisValve.H"
refuses 'includes "mesh", but src/openfoam has only its own and the public headers'
rm -rf "$scratch"

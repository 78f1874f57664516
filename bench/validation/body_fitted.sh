#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compares open leaflets that are walls of no thickness in a body-fitted mesh with the same leaflets as obstacles of riis.
# Both use the same solver and flow: bench/validation/body_fitted.sh FOLDER [--quick] A piece
# of the valve between its planes of symmetry lies in a tube. Blood with ten times its
# viscosity enters with a uniform velocity of 0.5 m/s. The effective area is Q / sqrt(2 dp /
# rho). Here dp is the total pressure at the inlet minus the pressure at the outlet. The jet
# still exists at the outlet, so it has not regained pressure. FOLDER gets the table
# body_fitted.txt, the rows body_fitted.json, pictures, and the cases. A complete case in
# FOLDER is not run again.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "$0")")
[[ ${1:-} && ${1:-} != -* && (${2:-} == '' || ${2:-} == --quick) && $# -le 2 ]] || {
  echo "usage: bench/validation/body_fitted.sh FOLDER [--quick]" >&2
  exit 2
}
mkdir -p "$1"
out=$(readlink -f -- "$1")
quick=${2:-}
cd -- "$here/../.."

# openfoam.sh fetches OpenFOAM's headers and builds the plug-in. It uses the variables and functions that are set here.
build=build n_jobs=$(nproc)
say() { printf '==> %s\n' "$*"; }
step() {
  say "$1"
  "${@:2}"
}
# shellcheck source=examples/openfoam/openfoam.sh
. examples/openfoam/openfoam.sh
of_work=$PWD/$build/openfoam
mkdir -p "$of_work" "$out/meshes" "$out/cases"
openfoam_has_source || exit 1
openfoam_build >"$out/build.log" 2>&1 || {
  tail -n 40 "$out/build.log" >&2
  exit 1
}
openfoam_environment

# logged LOG COMMAND...: runs the command with its output in the file. If the command fails, shows the file's end.
logged() {
  "${@:2}" >"$1" 2>&1 && return
  printf 'failed: %s; the end of %s:\n' "${*:2}" "$1" >&2
  tail -n 20 "$1" >&2
  return 1
}

# Tests whether OpenFOAM can run a function object in the folder of the mesh. This function replaces the one in openfoam.sh.
openfoam_function_object() { "${of_with[@]}" postProcess -case "$mesh" -func writeCellCentres -time 0; }

# make_mesh NAME VALVE FITTED SIZE BAND [FAR [SOLID]]: makes a mesh with gmsh, in meshes/NAME. VALVE is the name of the .geo file,
# a hyphen, and the opening. The other arguments are options of the .geo file. Lengths are in centimetres.
make_mesh() {
  mesh=$out/meshes/$1
  [[ ! -e $mesh/complete ]] || return 0
  rm -rf "$mesh"
  cp -r "$here/steady_case" "$mesh"
  logged "$mesh/log.gmsh" gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber opening "${2#*-}" \
    -setnumber fitted "$3" -setnumber size "$4" -setnumber band "$5" -setnumber far "${6:-0.13}" -setnumber solid "${7:-0}" \
    -format msh22 -o "$mesh/mesh.msh" "$here/${2%%-*}.geo" &&
    logged "$mesh/log.gmshToFoam" gmshToFoam -case "$mesh" "$mesh/mesh.msh" || return
  sed -i '/^ *wall$/,/}/s/patch;/wall;/; /^ *planes$/,/}/s/patch;/symmetry;/; /physicalType/d' "$mesh/constant/polyMesh/boundary"
  if (($3)); then
    logged "$mesh/log.createBaffles" createBaffles -case "$mesh" -overwrite || return
    cp -r "$here/steady_case/0" "$mesh" # createBaffles gave the new walls their own boundary conditions
  fi
  logged "$mesh/log.checkMesh" checkMesh -case "$mesh" -constant && grep -q '^Mesh OK' "$mesh/log.checkMesh" &&
    rm "$mesh/mesh.msh" && touch "$mesh/complete"
}

# set_valve CASE VALVE EPS RIM RESISTANCE: writes the valve and its numbers into the case's fvOptions.
set_valve() {
  sed -i "s/halfThickness .*/halfThickness $3;/; s/rim .*/rim $4;/; s/resistance .*/resistance $5;/; s/kind .*/kind ${2%%-*}; }/
    s/opening 1;/opening ${2#*-};/" "$1/system/fvOptions"
}

# run_case NAME MESH VALVE [EPS RIM RESISTANCE]: runs simpleFoam. EPS is in metres. If walls replace riis in a mesh, it has no
# EPS, RIM and RESISTANCE.
run_case() {
  local case=$out/cases/$1
  [[ ! -e $case/complete ]] || return 0
  rm -rf "$case"
  cp -r "$here/steady_case" "$case"
  cp -r "$out/meshes/$2/constant/polyMesh" "$case/constant"
  if [[ ${4:-} ]]; then
    set_valve "$case" "${@:3}"
  else
    rm "$case/system/fvOptions"
  fi
  logged "$case/log.simpleFoam" timeout 3600 "${of_with[@]}" simpleFoam -case "$case" && touch "$case/complete" &&
    rm -rf "$case/constant/polyMesh" && say "$1"
}

# run_blood NAME: continues with blood's viscosity from the steady flow of the case. The unsteady run is in blood/NAME.
run_blood() {
  local case=$out/blood/$1 mesh=$1 from
  [[ ! -e $case/complete ]] || return 0
  if [[ $mesh == riis-* ]]; then
    mesh=free-${mesh#riis-}
    mesh=${mesh%-*-*}
  fi
  from=$(find "$out/cases/$1" -maxdepth 1 -name '[1-9]*')
  rm -rf "$case"
  mkdir -p "$out/blood"
  cp -r "$out/cases/$1" "$case"
  rm -rf "$case"/[0-9]* "$case/postProcessing" "$case/complete"
  cp -r "$from" "$case/0"
  rm -rf "$case/0/uniform"
  cp -r "$out/meshes/$mesh/constant/polyMesh" "$case/constant"
  sed -i 's/nu .*/nu 3.3e-6;/' "$case/constant/transportProperties"
  sed -i 's/steadyState/backward/; s/bounded Gauss/Gauss/' "$case/system/fvSchemes"
  sed -i 's/deltaT .*/deltaT 1e-4; adjustTimeStep yes; maxCo 6; maxDeltaT 1e-3;/; s/endTime .*/endTime 0.1;/
    s/writeControl timeStep;/writeControl adjustableRunTime;/; s/writeInterval .*/writeInterval 0.1;/' "$case/system/controlDict"
  sed -i 's/^    U {/    pFinal { $p; relTol 0.01; }\n    "U|UFinal" {/
    s/^SIMPLE/PIMPLE { nCorrectors 2; nOuterCorrectors 1; }\nSIMPLE/; s/^relaxationFactors.*//' "$case/system/fvSolution"
  logged "$case/log.pimpleFoam" timeout 3600 "${of_with[@]}" pimpleFoam -case "$case" && touch "$case/complete" &&
    rm -rf "$case/constant/polyMesh" && say "$1, in time"
}

# same_leaflets VALVE: writes the leaflets of the fitted mesh and the leaflets of the library into the folder leaflets-VALVE. The
# half thickness of 0.1 mm makes the library's triangles exact to 0.005 mm.
same_leaflets() {
  local case=$out/leaflets-$1 first
  [[ ! -e $case/complete ]] || return 0
  first=$(find "$out/meshes" -maxdepth 1 -name "free-$1-*" | sort | tail -n 1)
  rm -rf "$case"
  cp -r "$first" "$case" && set_valve "$case" "$1" 1e-4 round 1e3 &&
    sed -i 's/velocity no;/velocity no; writeLeaflets yes;/' "$case/system/fvOptions" &&
    sed -i 's/endTime .*/endTime 1;/; s/writeInterval .*/writeInterval 1;/' "$case/system/controlDict" &&
    logged "$case/log.simpleFoam" "${of_with[@]}" simpleFoam -case "$case" &&
    mv "$case/postProcessing/valve/1/leaflets.vtk" "$case" || return
  logged "$case/log.gmsh" gmsh -2 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber opening "${1#*-}" -setnumber fitted 1 \
    -setnumber size 0.05 -setnumber band 0.1 -format msh22 -o "$case/fitted.msh" "$here/${1%%-*}.geo" &&
    rm -rf "$case"/[0-9]* "$case/constant" "$case/postProcessing" && touch "$case/complete"
}

# in_turn FUNCTION LINES: calls the function with the words of each line. As many calls run at once as there are processors.
in_turn() {
  local line words pids=() pid status=0
  while read -r line; do
    [[ $line ]] || continue
    read -ra words <<<"$line"
    "$1" "${words[@]}" &
    pids+=($!)
    if ((${#pids[@]} >= n_jobs)); then
      wait "${pids[0]}" || status=1
      pids=("${pids[@]:1}")
    fi
  done <<<"$2"
  for pid in "${pids[@]}"; do wait "$pid" || status=1; done
  return "$status"
}

# A case with walls has the name fitted-VALVE-SIZE, a case with solid leaflets solid-VALVE-EPS-SIZE. A case of riis has the name
# riis-VALVE-EPS-SIZE-RIM-RESISTANCE. SIZE is the length of the edges in the band. Lengths are in centimetres.
meshes='' cases='' blood=''
# fitted VALVE SIZE [FAR]: adds a case with walls and its mesh. FAR is the length of the edges elsewhere, by default 0.13.
fitted() {
  meshes+="fitted-$1-$2${3:+-$3} $1 1 $2 0.06 ${3:-}"$'\n'
  cases+="fitted-$1-$2${3:+-$3} fitted-$1-$2${3:+-$3} $1"$'\n'
}
# solid VALVE EPS SIZE: adds a case with solid leaflets of the thickness 2 EPS, with square edges, and its mesh.
solid() {
  meshes+="solid-$1-$2-$3 $1 0 $3 $(awk -v a="$2" -v b="$3" 'BEGIN { print a + b }') 0.13 $2"$'\n'
  cases+="solid-$1-$2-$3 solid-$1-$2-$3 $1"$'\n'
}
# obstacle VALVE EPS SIZE RIM [RESISTANCE]: adds a case of riis and its mesh. Up to the distance EPS + SIZE from the
# leaflet, edges have the length SIZE.
obstacle() {
  local name=free-$1-$2-$3 line
  line="$name $1 0 $3 $(awk -v a="$2" -v b="$3" 'BEGIN { print a + b }')"
  [[ $meshes == *"$line"* ]] || meshes+=$line$'\n'
  cases+="riis-$1-$2-$3-$4-${5:-1e3} $name $1 $(awk -v a="$2" 'BEGIN { print a / 100 }') $4 ${5:-1e3}"$'\n'
}

valves=(bileaflet-1)
if [[ $quick ]]; then
  fitted bileaflet-1 0.1
  fitted bileaflet-1 0.05
  solid bileaflet-1 0.1 0.05
  solid bileaflet-1 0.07 0.035
  for rim in round cut; do
    obstacle bileaflet-1 0.1 0.05 "$rim"
    obstacle bileaflet-1 0.07 0.035 "$rim"
  done
else
  for size in 0.1 0.07 0.05 0.035 0.025; do fitted bileaflet-1 "$size"; done
  fitted bileaflet-1 0.035 0.09
  solid bileaflet-1 0.1 0.05
  solid bileaflet-1 0.07 0.035
  solid bileaflet-1 0.05 0.025
  valves+=(bileaflet-0.75 bileaflet-0.5)
  for valve in "${valves[@]}"; do
    [[ $valve == bileaflet-1 ]] || for size in 0.05 0.035 0.025; do fitted "$valve" "$size"; done
    for rim in round cut; do
      obstacle "$valve" 0.1 0.05 "$rim"
      obstacle "$valve" 0.07 0.035 "$rim"
      obstacle "$valve" 0.05 0.025 "$rim"
    done
  done
  # Further cases have a smaller half thickness, other numbers of edges across the band, or other resistances.
  for rim in round cut; do
    obstacle bileaflet-1 0.035 0.0175 "$rim"
    obstacle bileaflet-1 0.1 0.1 "$rim"
    obstacle bileaflet-1 0.1 0.025 "$rim"
  done
  obstacle bileaflet-1 0.1 0.05 round 1e2
  obstacle bileaflet-1 0.1 0.05 round 1e4
  blood='fitted-bileaflet-1-0.05
    riis-bileaflet-1-0.1-0.05-round-1e3
    riis-bileaflet-1-0.07-0.035-round-1e3'
  valves+=(trileaflet-1)
  for size in 0.05 0.035 0.025; do fitted trileaflet-1 "$size"; done
  for rim in round cut; do
    obstacle trileaflet-1 0.1 0.05 "$rim"
    obstacle trileaflet-1 0.07 0.035 "$rim"
    obstacle trileaflet-1 0.05 0.025 "$rim"
  done
fi

in_turn make_mesh "$meshes"
mesh=$out/meshes/$(head -n 1 <<<"$meshes" | cut -d ' ' -f 1)
openfoam_digests
in_turn run_case "$cases"
in_turn run_blood "$blood"
in_turn same_leaflets "$(printf '%s\n' "${valves[@]}")"
python=python3
[[ ! -x /usr/bin/python3 ]] || python=/usr/bin/python3
"$python" -B "$here/body_fitted.py" "$out" | tee "$out/body_fitted.txt"

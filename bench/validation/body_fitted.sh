#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench/validation/body_fitted.sh FOLDER [--quick]
# Compares open leaflets in two forms: as walls without thickness in a body-fitted mesh, and as obstacles of riis. Both forms use
# the same solver and flow. A piece of the valve between its planes of symmetry lies in a tube. Blood with ten times its viscosity
# enters with a uniform velocity of 0.5 m/s. The effective area is Q / sqrt(2 dp / rho). Here dp is the total pressure at the
# inlet minus the pressure at the outlet. At the outlet, the jet still exists and has not regained pressure. FOLDER gets the table
# body_fitted.txt, the rows body_fitted.json, pictures, and the cases. Only cases whose rows all.json lacks are run, and a
# complete case in FOLDER is not run again. To measure a row again, remove it from all.json. If a case fails, the remaining cases
# still run, and the status is 1.
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

# openfoam.sh fetches OpenFOAM's headers and builds the plug-in. openfoam.sh uses the variables and functions that are set here.
build=build n_jobs=$(nproc) python=python3
[[ ! -x /usr/bin/python3 ]] || python=/usr/bin/python3
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
gcc -O2 -I "$of_work/riis/include" -o "$of_work/points" "$here/points.c" -L "$of_work/riis/lib" -lriis -lm

# logged LOG COMMAND...: runs the command with its output in the file. If the command fails, shows the file's end.
logged() {
  "${@:2}" >"$1" 2>&1 && return
  printf 'failed: %s; the end of %s:\n' "${*:2}" "$1" >&2
  tail -n 20 "$1" >&2
  return 1
}

# Tests whether OpenFOAM can run a function object in the folder of the mesh. This function replaces the one in openfoam.sh.
openfoam_function_object() { "${of_with[@]}" postProcess -case "$mesh" -func writeCellCentres -time 0; }

# geometry FOLDER VALVE: prints the path of the valve's .geo file. If no .geo file exists, the function writes one into the
# folder, by a script of the kind or from points of the library. VALVE is the kind, a hyphen, and the opening.
geometry() {
  local kind=${2%%-*}
  if [[ -e $here/$kind.geo ]]; then
    echo "$here/$kind.geo"
    return
  fi
  if [[ -e $here/$kind.py ]]; then
    "$python" -B "$here/$kind.py" "${2#*-}" >"$1/$kind.geo" && cp "$here/fluid.geo" "$1" && echo "$1/$kind.geo"
    return
  fi
  LD_LIBRARY_PATH=$of_work/riis/lib "$of_work/points" "$kind" "${2#*-}" >"$1/$kind.geo" &&
    cat "$here/cusps.geo" >>"$1/$kind.geo" && cp "$here"/{patches,fluid}.geo "$1" && echo "$1/$kind.geo"
}

# make_mesh NAME VALVE FITTED SIZE BAND [FAR [SOLID]]: makes a mesh with gmsh, in meshes/NAME. The arguments after VALVE are
# options of the .geo file. Lengths are in centimetres.
make_mesh() {
  local geo
  mesh=$out/meshes/$1
  [[ ! -e $mesh/complete ]] || return 0
  rm -rf "$mesh"
  cp -r "$here/steady_case" "$mesh"
  geo=$(geometry "$mesh" "$2") || return
  logged "$mesh/log.gmsh" gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber opening "${2#*-}" \
    -setnumber fitted "$3" -setnumber size "$4" -setnumber band "$5" -setnumber far "${6:-0.13}" -setnumber solid "${7:-0}" \
    -format msh22 -o "$mesh/mesh.msh" "$geo" &&
    logged "$mesh/log.gmshToFoam" gmshToFoam -case "$mesh" "$mesh/mesh.msh" || return
  sed -i '/^ *wall$/,/}/s/patch;/wall;/; /^ *planes$/,/}/s/patch;/symmetry;/; /physicalType/d' "$mesh/constant/polyMesh/boundary"
  if (($3)); then
    logged "$mesh/log.createBaffles" createBaffles -case "$mesh" -overwrite || return
    cp -r "$here/steady_case/0" "$mesh" # createBaffles gave the new walls their own boundary conditions
  fi
  logged "$mesh/log.checkMesh" checkMesh -case "$mesh" -constant && grep -q '^Mesh OK' "$mesh/log.checkMesh" &&
    rm "$mesh/mesh.msh" && touch "$mesh/complete"
}

# set_valve CASE VALVE EPS RIM RESISTANCE OFFSET: writes the valve and its numbers into the case's fvOptions. The mitral valve is
# turned over, because the flow has the direction z.
set_valve() {
  local valve="kind ${2%%-*};" turn=''
  [[ $2 != mitral* ]] || valve+=' translation (0 0 0);' turn=' rotationAxis (1 0 0); rotationAngle 180;'
  sed -i "s/halfThickness .*/halfThickness $3;/; s/rim .*/rim $4;/; s/resistance .*/resistance $5;/; s/offset .*/offset $6;/
    s/kind .*/$valve }/; s/scale 0.01;/&$turn/; s/opening 1;/opening ${2#*-};/" "$1/system/fvOptions"
}

# run_case NAME MESH VALVE [EPS RIM RESISTANCE OFFSET]: runs simpleFoam. EPS is in metres. In a mesh with walls instead of riis,
# EPS, RIM, RESISTANCE and OFFSET are missing.
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
  logged "$case/log.simpleFoam" timeout 14400 "${of_with[@]}" simpleFoam -case "$case" && touch "$case/complete" &&
    rm -rf "$case/constant/polyMesh" && say "$1"
}

# run_blood NAME: continues the steady flow of the case with blood's viscosity. The unsteady run is in blood/NAME.
run_blood() {
  local case=$out/blood/$1 mesh=$1 from words
  [[ ! -e $case/complete ]] || return 0
  IFS=- read -ra words <<<"$1"
  if [[ ${words[0]} == riis ]]; then
    mesh=free
    [[ ! ${words[7]:-} ]] || mesh=wide
    mesh+=-${words[1]}-${words[2]}-${words[3]}-${words[4]}
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

# same_leaflets VALVE: writes the leaflets of the fitted mesh and those of the library into the folder leaflets-VALVE. With the
# half thickness of 0.1 mm, the library's triangles are exact to 0.005 mm.
same_leaflets() {
  local case=$out/leaflets-$1 first geo
  [[ ! -e $case/complete ]] || return 0
  first=$(find "$out/meshes" -maxdepth 1 \( -name "free-$1-*" -o -name "wide-$1-*" \) | sort | tail -n 1)
  rm -rf "$case"
  cp -r "$first" "$case" && rm "$case/complete" && set_valve "$case" "$1" 1e-4 round 1e3 0 &&
    sed -i 's/velocity no;/velocity no; writeLeaflets yes;/' "$case/system/fvOptions" &&
    sed -i 's/endTime .*/endTime 1;/; s/writeInterval .*/writeInterval 1;/' "$case/system/controlDict" &&
    logged "$case/log.simpleFoam" "${of_with[@]}" simpleFoam -case "$case" &&
    mv "$case/postProcessing/valve/1/leaflets.vtk" "$case" && geo=$(geometry "$case" "$1") || return
  logged "$case/log.gmsh" gmsh -2 -nt 1 -setnumber Mesh.ScalingFactor 0.01 -setnumber opening "${1#*-}" -setnumber fitted 1 \
    -setnumber size 0.05 -setnumber band 0.1 -format msh22 -o "$case/fitted.msh" "$geo" &&
    rm -rf "$case"/[0-9]* "$case/constant" "$case/postProcessing" && touch "$case/complete"
}

# in_turn FUNCTION LINES: calls the function with the words of each line. One call for each processor runs at once.
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

# A case with walls has the name fitted-VALVE-SIZE, and a case with solid leaflets solid-VALVE-EPS-SIZE. A case of riis has the
# name riis-VALVE-EPS-SIZE-RIM-RESISTANCE. -OFFSET, -FAR and -BAND may follow. SIZE is the length of the edges in the band.
# Lengths are in centimetres.
meshes='' cases='' blood='' valves=()
# add MESH CASE: adds the line of a mesh and the line of a case, each once. A line begins with the name.
add() {
  [[ $'\n'$meshes == *$'\n'"${1%% *} "* ]] || meshes+=$1$'\n'
  [[ $'\n'$cases == *$'\n'"${2%% *} "* ]] || cases+=$2$'\n'
}
# fitted VALVE SIZE [FAR]: adds a case with walls and its mesh. FAR is the length of the edges elsewhere, by default 0.13.
fitted() {
  local name=fitted-$1-$2${3:+-$3}
  add "$name $1 1 $2 0.06 ${3:-}" "$name $name $1"
}
# solid VALVE EPS SIZE: adds a case with solid leaflets of the thickness 2 EPS, with square edges, and its mesh.
solid() {
  local name=solid-$1-$2-$3
  add "$name $1 0 $3 $(awk -v a="$2" -v b="$3" 'BEGIN { print a + b }') 0.13 $2" "$name $name $1"
}
# obstacle VALVE EPS SIZE RIM [RESISTANCE [OFFSET [FAR [BAND]]]]: adds a case of riis and its mesh. Up to the distance BAND from
# the leaflet, edges have the length SIZE. BAND is EPS + SIZE by default. With OFFSET, BAND is 1.75 EPS + SIZE by default, so that
# one mesh serves offsets from 0 to 0.85. FAR is as above.
obstacle() {
  local more=${7:+-$7}${8:+-$8} name band=${8:-}
  name=${6:+wide}
  name=${name:-free}-$1-$2-$3$more
  [[ $band ]] || band=$(awk -v a="$2" -v b="$3" -v wide="${6:+0.75}" 'BEGIN { print a * (1 + wide) + b }')
  add "$name $1 0 $3 $band ${7:-}" \
    "riis-$1-$2-$3-$4-${5:-1e3}${6:+-$6}$more $name $1 $(awk -v a="$2" 'BEGIN { print a / 100 }') $4 ${5:-1e3} ${6:-0}"
}
# finished ID: tells whether all.json has the row. If all.json has the row, the row's cases need not run.
finished() { grep -qF "\"id\": \"$1\"" "$here/all.json"; }
# beside VALVE EPS OFFSET: adds the case of the valve with this offset if all.json lacks its row. EPS is in millimetres.
beside() {
  local eps
  ! finished "offset_${1/-/_}_$2_$3" || return 0
  eps=$(awk -v a="$2" 'BEGIN { print a / 10 }')
  obstacle "$1" "$eps" "$(awk -v a="$eps" 'BEGIN { print a / 2 }')" cut 1e3 "$3"
  [[ " ${valves[*]} " == *" $1 "* ]] || valves+=("$1")
}

# The open bileaflet valve.
bileaflet() {
  local size rim
  valves+=(bileaflet-1)
  for size in 0.1 0.07 0.05 0.035 0.025; do fitted bileaflet-1 "$size"; done
  fitted bileaflet-1 0.035 0.09
  solid bileaflet-1 0.1 0.05
  solid bileaflet-1 0.07 0.035
  solid bileaflet-1 0.05 0.025
  for rim in round cut; do
    obstacle bileaflet-1 0.1 0.05 "$rim"
    obstacle bileaflet-1 0.07 0.035 "$rim"
    obstacle bileaflet-1 0.05 0.025 "$rim"
    # Further cases have a smaller half thickness, other numbers of edges across the band, or other resistances.
    obstacle bileaflet-1 0.035 0.0175 "$rim"
    obstacle bileaflet-1 0.1 0.1 "$rim"
    obstacle bileaflet-1 0.1 0.025 "$rim"
  done
  obstacle bileaflet-1 0.1 0.05 round 1e2
  obstacle bileaflet-1 0.1 0.05 round 1e4
  blood+=$'fitted-bileaflet-1-0.05\nriis-bileaflet-1-0.1-0.05-round-1e3\nriis-bileaflet-1-0.07-0.035-round-1e3\n'
}

# some_open VALVE: adds cases of a valve as walls and as obstacle, with three sizes.
some_open() {
  local size rim
  valves+=("$1")
  for size in 0.05 0.035 0.025; do fitted "$1" "$size"; done
  for rim in round cut; do
    obstacle "$1" 0.1 0.05 "$rim"
    obstacle "$1" 0.07 0.035 "$rim"
    obstacle "$1" 0.05 0.025 "$rim"
  done
}

# Adds the valves whose band has an offset. Walls come first, and the cases with bars follow.
beside_leaflets() {
  local offset valve size far three=(trileaflet-1 trileaflet-0.5 trileaflet-0.25) two=(coapting-1 coapting-0.5) some
  for offset in 0.75 0; do for valve in "${three[@]}"; do beside "$valve" 1 "$offset"; done; done
  for offset in 0.75 0; do for valve in "${three[@]}"; do beside "$valve" 0.5 "$offset"; done; done
  for valve in "${three[@]}"; do beside "$valve" 1 0.5; done
  if [[ $cases == *riis-trileaflet-0.25-0.1-0.05-cut-1e3-0.75* ]]; then # the smallest area depends on the mesh
    for far in 0.08 0.1 0.11 0.12 0.14 0.15 0.16; do obstacle trileaflet-0.25 0.1 0.05 cut 1e3 0.75 "$far"; done
  fi
  for valve in "${two[@]}"; do
    for offset in 0.85 0.75 0.5 0; do beside "$valve" 1 "$offset"; done
    for offset in 0.75 0; do beside "$valve" 0.5 "$offset"; done
  done
  for offset in 0.75 0.5 0; do for valve in mitral-1 mitral-0.5; do beside "$valve" 1 "$offset"; done; done
  some=$cases cases=''
  for valve in "${valves[@]}"; do
    for size in 0.05 0.03; do fitted "$valve" "$size"; done
    [[ $valve == mitral* ]] || fitted "$valve" 0.02 # the mitral valve would have a million cells
  done
  cases+=$some
  finished offset_blood_trileaflet_0.5_1_0.75 || {
    fitted trileaflet-0.5 0.03
    for offset in 0.75 0; do obstacle trileaflet-0.5 0.1 0.05 cut 1e3 "$offset"; done
    blood+=$'fitted-trileaflet-0.5-0.03\nriis-trileaflet-0.5-0.1-0.05-cut-1e3-0.75\nriis-trileaflet-0.5-0.1-0.05-cut-1e3-0\n'
  }
}

if [[ $quick ]]; then
  valves+=(bileaflet-1)
  fitted bileaflet-1 0.1
  fitted bileaflet-1 0.05
  solid bileaflet-1 0.1 0.05
  solid bileaflet-1 0.07 0.035
  for rim in round cut; do
    obstacle bileaflet-1 0.1 0.05 "$rim"
    obstacle bileaflet-1 0.07 0.035 "$rim"
  done
else
  beside_leaflets
  finished bodyfit_bileaflet_1_cut_line || bileaflet
  for valve in bileaflet-0.75 bileaflet-0.5 trileaflet-1; do
    finished "bodyfit_${valve/-/_}_cut_line" || some_open "$valve"
  done
fi

status=0
in_turn make_mesh "$meshes" || status=1
mesh=$out/meshes/$(head -n 1 <<<"$meshes" | cut -d ' ' -f 1)
[[ ! $meshes ]] || openfoam_digests
in_turn run_case "$cases" || status=1
in_turn run_blood "$blood" || status=1
in_turn same_leaflets "$(printf '%s\n' "${valves[@]}")" || status=1
"$python" -B "$here/body_fitted.py" "$out" ${quick:+--quick} | tee "$out/body_fitted.txt"
((status == 0))

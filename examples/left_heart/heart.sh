# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run heart: a beating left heart in OpenFOAM, with a mitral and an aortic valve. `run` sources this file after
# examples/openfoam/openfoam.sh, whose steps build the plug-in and set OpenFOAM's environment.

heart_here=examples/left_heart
heart_fused='kind bicuspid; commissure_0.fusion 0.28; commissure_1.fusion 0.28; skirt_length 0.5;' # the stenotic aortic valve
heart_coapting='kind mitral_coapting; AP_diameter 3.1; ALPM_diameter 4; translation (0 0.1 1.2); skirt_length 1;'
heart_flail='bump_0.leaflet 1; bump_0.lift 1.3; bump_0.width 0.45;'
# The clip draws the flail P2 down, and holds A2 and P2 together.
heart_clip='bump_0.leaflet 1; bump_0.lift 0.3; bump_0.width 0.45; bump_1.leaflet 0; bump_1.open 0.3; bump_1.width 0.2;
  bump_2.leaflet 1; bump_2.open 0.3; bump_2.width 0.2;'
heart_least_opening=1e-4 # of the flail valve, whose table then has an orifice in place of a leak
# shellcheck source=examples/left_heart/coupled/coupled.sh
. "$heart_here/coupled/coupled.sh"

# ./run heart [--resume] [--offset O] [--all | --coupled | --walls] [--short]
#   Computes a beating left heart in OpenFOAM: a ventricle with a moving wall, and with a mitral and an aortic valve. A 0D model
#   drives this heart. The command measures leaks, and checks the balance of blood, the pressures, 1 and 2 ranks and a restart.
#   The command leaves tables, pictures and a movie in out/heart. --all adds three hearts: with a stenotic aortic valve, with a
#   flail mitral leaflet, and with a clip on this leaflet. --short computes one beat on a coarse mesh. --offset 0 has bands around
#   the leaflets with round rims. By default, bands are shifted by 0.75 half thicknesses, and have cut rims. With --coupled, the
#   pressures of the flow open the valves, and the wall moves by its elastance. --walls compares the open aortic valve with the
#   same leaflets as walls. --resume continues a run that was cut off. Like openfoam, the command is left out if Debian's package
#   is missing.
run_heart() {
  local python name of_keep=
  heart_offset=0.75
  [[ ${1:-} != --resume ]] || { of_keep=yes && shift; }
  [[ ${1:-} != --offset || $# -lt 2 ]] || { heart_offset=$2 && shift 2; }
  heart_fine=2.2 heart_coarse=4.5 heart_half_thickness=1.8e-3 heart_beats=3 heart_only='' heart_diseases=()
  case $* in
    '' | --short | --all | '--all --short') ;;
    --coupled | '--coupled --short') heart_only=coupled ;;
    --walls | '--walls --short') heart_only=walls ;;
    *)
      echo "./run heart: '$*' is not an option" >&2
      exit 2
      ;;
  esac
  [[ $heart_only$of_keep != wallsyes ]] || refuse "--resume does not go with --walls"
  [[ $* != --all* ]] || heart_diseases=(stenosis flail clip)
  [[ $* != *--short ]] || heart_fine=3.5 heart_coarse=8 heart_half_thickness=2.3e-3 heart_beats=1
  openfoam_start left_heart_cases heart ffmpeg || return 0
  step "build the motions of the wall" heart_build
  export LD_LIBRARY_PATH=$of_work/left_heart:$LD_LIBRARY_PATH
  of_with=()
  python=$(python_of_packages)
  heart_python() { "$python" -B "$heart_here/$1" "${@:2}"; }

  if [[ $of_keep ]]; then
    [[ -e $of_cases/${heart_only:-beat}/log.pimpleFoam ]] || {
      echo "./run heart: --resume finds no run in $of_cases/${heart_only:-beat}" >&2
      exit 2
    }
  else
    step "mesh the heart" heart_mesh
    if [[ $heart_only == walls ]]; then
      heart_walls
      return
    fi
    step "measure what the mitral valve leaves to the flow at each opening" heart_orifice mitral
    step "measure what the aortic valve leaves to the flow at each opening" heart_orifice aortic
  fi
  if [[ $heart_only ]]; then
    heart_coupled
    say "wrote out/heart, and the beat in $of_cases/coupled"
    return
  fi
  [[ $of_keep ]] || step "a heart without space" heart_zero_d beat "$of_out" "$heart_beats"
  cat "$of_out/zero_d.txt"
  step "$heart_beats beats of the heart" heart_run beat
  heart_python check.py beat "$of_cases/beat" "$of_out/zero_d.csv" "$of_out/mitral.csv" "$of_out/aortic.csv" | tee \
    "$of_out/beat.txt"
  step "40 steps on 1 and 2 ranks, and a restart" heart_ranks
  heart_python check.py ranks "$of_cases/ranks-1" "$of_cases/ranks-2" | tee "$of_out/ranks.txt"
  heart_python check.py restart "$of_cases/ranks-1" "$of_cases/restart" | tee "$of_out/restart.txt"
  step "bad input, which must be refused" heart_refusals
  cat "$of_out/refusals.txt"
  local hearts=("$of_cases/beat" "$of_out")
  step "draw" heart_python draw.py "$of_cases/beat" "$of_out/zero_d.csv" "$of_out"
  for name in "${heart_diseases[@]}"; do
    heart_diseased "$name"
    hearts+=("$of_cases/$name" "$of_out/$name")
  done
  [[ ! ${heart_diseases[*]} ]] || step "draw the diseased hearts" heart_draw_diseases
  heart_python clinic.py "${hearts[@]}" | tee "$of_out/clinic.txt"
  say "wrote out/heart, and the beat in $of_cases/beat"
}

# heart_draw_diseases: draws all hearts beside each other.
heart_draw_diseases() {
  local cases=("$of_cases/beat" "${heart_diseases[@]/#/$of_cases/}")
  heart_python draw.py loops "$of_out/loops.png" "${hearts[@]}" && heart_python draw.py hearts "$of_out/hearts.png" "${cases[@]}"
}

# heart_run NAME: runs the case on one rank, from its last written time. The log grows if the run was cut off before.
heart_run() {
  local log=$of_cases/$1/log.pimpleFoam
  timeout 14400 "${of_with[@]}" pimpleFoam -case "$of_cases/$1" >>"$log" 2>&1 && return
  echo "failed: pimpleFoam -case $of_cases/$1; the end of $log:" >&2
  tail -n 20 "$log" >&2
  return 1
}

heart_build() {
  cmake -S "$heart_here" -B "$of_work/left_heart" -G Ninja -D CMAKE_BUILD_TYPE=Release \
    -D OPENFOAM_SOURCE="$of_source/src" &&
    cmake --build "$of_work/left_heart"
}

# heart_mesh: makes the mesh in the folder mesh of the cases.
heart_mesh() {
  local folder=$of_cases/mesh
  cp -r "$heart_here/case" "$folder" &&
    gmsh -3 -nt 1 -setnumber fine "$heart_fine" -setnumber coarse "$heart_coarse" -format msh22 -o "$folder/heart.msh" \
      "$heart_here/heart.geo" &&
    heart_held mesh 0 0 &&
    sed -i 's/writeFormat binary/writeFormat ascii/' "$folder/system/controlDict" &&
    of_from_gmsh "$folder" "$folder/heart.msh" && of_mesh_is_fine "$folder" && topoSet -case "$folder"
}

# heart_case NAME [DISEASE]: copies the case and its mesh to $of_cases/NAME. With stenosis the aortic valve has two cusps that are
# fused at both commissures. With flail the middle of the mitral valve's posterior leaflet lies in the atrium. With clip the same
# place is clipped to the anterior leaflet.
heart_case() {
  rm -rf "${of_cases:?}/$1"
  cp -r "$heart_here/case" "$of_cases/$1" &&
    cp -r "$of_cases/mesh/constant/polyMesh" "$of_cases/$1/constant" &&
    heart_band "$1" mitral "$heart_offset" || return
  case ${2:-} in
    stenosis) of_set "$1" system/fvOptions aortic/valve "{ $heart_fused }" ;;
    flail) of_set "$1" system/fvOptions mitral/valve "{ $heart_coapting $heart_flail }" && heart_uncalibrated "$1" ;;
    clip) of_set "$1" system/fvOptions mitral/valve "{ $heart_coapting $heart_clip }" ;;
  esac
}

# heart_uncalibrated NAME: a mitral valve with a gap cannot be calibrated, so it has the resistance that the calibration gives to
# the valve without the gap in the coarse mesh. The aortic valve, which copies the mitral one, is calibrated as before.
heart_uncalibrated() {
  of_set "$1" system/fvOptions mitral/calibrate no mitral/resistance 1.53e4 aortic/calibrate yes aortic/resistance 1e4
}

# heart_band NAME VALVE OFFSET: the band of the valve has the half thickness of this mesh and the offset. The aortic valve copies
# the entries of the mitral valve.
heart_band() {
  local rim=cut
  [[ $3 != 0 ]] || rim=round
  of_set "$1" system/fvOptions "$2/halfThickness" "$heart_half_thickness" "$2/offset" "$3" "$2/rim" "$rim"
}

# heart_held NAME INLET OUTLET: the heart stands still, with closed valves, between the pressures INLET and OUTLET in mmHg.
heart_held() {
  local constant=$of_cases/$1/constant valve
  echo 'amplitude table ((0 0) (2 0));' >"$constant/amplitude"
  awk -v p="$2" 'BEGIN { printf "p0 constant %.10g;\n", p * 133.322 / 1060 }' >"$constant/inletPressure"
  awk -v p="$3" 'BEGIN { printf "p0 constant %.10g;\n", p * 133.322 / 1060 }' >"$constant/outletPressure"
  for valve in mitral aortic; do echo 'period 0.8; keys ((0 0) (0.4 0));' >"$constant/${valve}Keys"; done
}

# heart_orifice VALVE [DISEASE]: the heart stands still, with the other valve open. The valve first opens without a pressure, and
# its leaflets displace the flow. Then the valve takes one opening after the other between 12 and 0 mmHg. The flow and the
# pressures give the area that each opening leaves, and the leak of the closed valve.
heart_orifice() {
  local name=orifice-$1${2:+-$2} folder=$of_out${2:+/$2} other=mitral least=0
  [[ $1 == aortic ]] || other=aortic
  [[ ${2:-} != flail ]] || least=$heart_least_opening
  heart_case "$name" "${2:-}" && heart_held "$name" 12 0 &&
    heart_python check.py keys "$least" >"$of_cases/$name/constant/$1Keys" &&
    sed -i 's/constant \(.*\);/table ((0 0) (0.164 0) (0.166 \1));/' "$of_cases/$name/constant/inletPressure" &&
    echo 'period 0.8; keys ((0 1) (0.4 1));' >"$of_cases/$name/constant/${other}Keys" &&
    of_set "$name" system/controlDict endTime 1.52 writeInterval 1.52 &&
    of_run "$name" 1 && heart_python check.py orifice "$of_cases/$name" "$1" "$least" >"$folder/$1.csv"
}

# heart_walls: the heart stands still, without a mitral valve, between 12 and 0 mmHg. The open aortic valve is a band with the
# offset, a band without it, and walls. createBaffles loses the cells that topoSet has found, so topoSet finds them again.
heart_walls() {
  local name
  for name in band-"$heart_offset" band-0; do
    step "the open aortic valve, $name" heart_steady "$name" "${name#*-}"
  done
  step "the open aortic valve as walls" heart_walled "$of_cases/band-$heart_offset"/postProcessing/aortic/*/leaflets.vtk
  heart_python walls.py table "$of_cases"/{walls,"band-$heart_offset",band-0} | tee "$of_out/walls.txt"
  say "wrote out/heart/walls.txt"
}

# heart_open NAME OFFSET: the case with an open aortic valve, without a mitral one.
heart_open() {
  heart_case "$1" && heart_held "$1" 12 0 &&
    echo 'period 0.8; keys ((0 1) (0.4 1));' >"$of_cases/$1/constant/aorticKeys" &&
    heart_band "$1" aortic "$2" && of_set "$1" system/fvOptions aortic/active yes mitral/active no &&
    of_set "$1" system/controlDict endTime 0.3
}

heart_steady() { heart_open "$1" "$2" && of_run "$1" 1; }

# heart_walled LEAFLETS...: takes the first file of leaflets.
heart_walled() {
  local case=$of_cases/walls side='{ name leaflets; type wall; }'
  heart_open walls 0 && of_set walls system/fvOptions aortic/active no &&
    heart_python walls.py faces "$case" "$1" &&
    foam_dict "$case" leafletsSet "actions
      ({ name leaflets; type faceZoneSet; action new; source setToFaceZone; faceSet leaflets; });" &&
    foam_dict "$case" leafletsWalls "internalFacesOnly true; noFields true; baffles
      { leaflets { type faceZone; zoneName leaflets; patches { master $side slave $side } } }" &&
    topoSet -case "$case" -dict system/leafletsSet && createBaffles -case "$case" -dict system/leafletsWalls -overwrite &&
    topoSet -case "$case" &&
    of_set walls 0/U boundaryField/leaflets '{ type noSlip; }' &&
    of_set walls 0/p boundaryField/leaflets '{ type zeroGradient; }' &&
    of_run walls 1
}

# foam_dict CASE NAME TEXT: writes a dictionary in the folder system.
foam_dict() { echo "FoamFile { version 2.0; format ascii; class dictionary; object $2; } $3" >"$1/system/$2"; }

# heart_zero_d CASE TABLES BEATS: makes the case, and its tables of motion, pressures and openings. The flail leaflet has dilated
# the ventricle, and the clip finds it so.
heart_zero_d() {
  local folder=$2 disease='' body=()
  [[ $1 == beat ]] || disease=$1
  [[ ! $disease =~ ^(flail|clip)$ ]] || body=(--dilated)
  heart_case "$1" "$disease" &&
    heart_python zero_d.py "$of_cases/$1" "$folder/mitral.csv" "$folder/aortic.csv" --beats "$3" "${body[@]}" \
      --out "$folder/zero_d.csv" >"$folder/zero_d.txt" &&
    of_set "$1" system/controlDict endTime "$(awk -v n="$3" 'BEGIN { print 0.8 * n }')"
}

# heart_diseased DISEASE: a beat of the heart with one diseased valve.
heart_diseased() {
  local folder=$of_out/$1 sick=aortic well=mitral
  [[ $1 == stenosis ]] || sick=mitral well=aortic
  mkdir -p "$folder" && cp "$of_out/$well.csv" "$folder"
  step "$1: measure what the $sick valve leaves to the flow" heart_orifice "$sick" "$1"
  step "$1: a heart without space" heart_zero_d "$1" "$folder" 1
  cat "$folder/zero_d.txt"
  step "$1: a beat" heart_run "$1"
  heart_python check.py beat "$of_cases/$1" "$folder"/{zero_d,mitral,aortic}.csv | tee "$folder/beat.txt"
}

# 40 steps from the start, with both valves closed at their end. The restart begins after 20 of the 40 steps. There is no
# calibration, because its factor differs between 1 and 2 ranks in the fourth digit (examples/openfoam/README.md). The heart is
# split between the ranks along y. On one rank a band then ends in a cell whose neighbours are all on the other rank. Pressures
# are solved to 1e-10. With the tolerances of the beats, the flows of the first step differ by 1.3e-4 in the coarse mesh.
heart_ranks() {
  local name
  for name in ranks-1 ranks-2 restart; do
    rm -rf "${of_cases:?}/$name"
    cp -r "$of_cases/beat" "$of_cases/$name" &&
      rm -rf "$of_cases/$name"/0.* "$of_cases/$name"/[1-9]* "$of_cases/$name"/postProcessing "$of_cases/$name"/log.* &&
      of_set "$name" system/controlDict endTime 0.08 && of_set "$name" system/fvOptions mitral/calibrate no &&
      of_set "$name" system/fvSolution solvers/p/tolerance 1e-10 solvers/p/relTol 0 solvers/pFinal/tolerance 1e-10 || return
  done
  of_run ranks-1 1 && of_run ranks-2 2 '1 2 1' &&
    cp -r "$of_cases/ranks-1/0.04" "$of_cases/restart" && of_run restart 1
}

# heart_refused NAME TEXT FILE ENTRY VALUE [ENTRY VALUE...]: the case with these entries must end with TEXT.
heart_refused() {
  local folder=refused-${1// /_}
  heart_case "$folder" && heart_held "$folder" 10 0 && of_set "$folder" "${@:3}" && of_refused "$1" "$folder" "$2"
}

# heart_refuses NAME TEXT COMMAND...: the command must fail with this text.
heart_refuses() {
  local message
  if message=$("${@:3}" 2>&1) || [[ $message != *"$2"* ]]; then
    echo "$1: not refused with '$2': $message" >&2
    return 1
  fi
  of_tell_refused "$1" "$2"
}

# heart_zero_d_refuses NAME TEXT MITRAL.csv AORTIC.csv
heart_zero_d_refuses() { heart_refuses "$1" "$2" heart_python zero_d.py "$of_cases/beat" "$3" "$4"; }

heart_refusals() {
  local motion=constant/dynamicMeshDict
  heart_refuses "an unknown option" "'--fast' is not an option" ./run heart --fast &&
    heart_refuses "a valve that never closes" "the least opening is 1, and must be at least 0 and below 1" \
      heart_python check.py keys 1 &&
    heart_refused "no length" "length is 0, and must be positive" "$motion" beatMotionCoeffs/length 0 &&
    heart_refused "no amplitude" "Unknown Function1 type none for amplitude" "$motion" beatMotionCoeffs/amplitude none &&
    heart_refused "an unknown law" "law is 'tabel', and must be" system/fvOptions mitral/opening '{ law tabel; }' &&
    heart_refused "a valve outside the heart" "no cell centre lies within the half thickness" system/fvOptions \
      aortic/placement '{ scale 0.008; translation (0 0 1); }' aortic/calibrate no &&
    heart_zero_d_refuses "no table of openings" "has no column opening" "$of_out/zero_d.csv" "$of_out/aortic.csv" &&
    sed '2,$s/^\([^,]*,[^,]*\),[^,]*/\1,0/' "$of_out/mitral.csv" >"$of_out/no_leak.csv" &&
    heart_zero_d_refuses "a leak of 0" "the leak is 0, and must be positive" "$of_out/no_leak.csv" "$of_out/aortic.csv" &&
    sed '$d' "$of_out/mitral.csv" >"$of_out/short.csv" &&
    heart_zero_d_refuses "no row for the open valve" "openings must ascend from 0 to 1" "$of_out/short.csv" \
      "$of_out/aortic.csv" &&
    rm "$of_out/no_leak.csv" "$of_out/short.csv"
}

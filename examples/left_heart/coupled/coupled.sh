# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run heart --coupled: the valves open by the pressures of the flow, and the wall moves by its elastance. heart.sh
# sources this file. The command makes the mesh and the tables of both valves first.

heart_coupled() {
  heart_python coupled/study.py "$of_work/left_heart/libvolumeSearch.so" | tee "$of_out/coupled_study.txt"
  [[ $of_keep ]] || step "the files of the coupled heart" heart_coupled_case coupled
  step "a beat of the coupled heart" heart_run coupled
  heart_python coupled/coupled.py check "$of_cases/coupled" "$of_out/mitral.csv" "$of_out/aortic.csv" | tee "$of_out/coupled.txt"
  step "prescribed volumes with valves that switch" heart_naive
  heart_python coupled/coupled.py naive "$of_cases/naive" "$of_cases/coupled" | tee "$of_out/coupled_naive.txt"
  step "20 steps on 2 ranks, and a restart" heart_coupled_ranks
  heart_python coupled/coupled.py ranks "$of_cases/coupled" "$of_cases/coupled-2" | tee "$of_out/coupled_ranks.txt"
  heart_python coupled/coupled.py restart "$of_cases/coupled" "$of_cases/coupled-restart" | tee -a "$of_out/coupled_ranks.txt"
  step "bad input, which must be refused" heart_coupled_refusals
  cat "$of_out/refusals.txt"
}

# heart_coupled_case NAME: makes the case, and copies the files of the coupled heart over it.
heart_coupled_case() {
  heart_case "$1" && cp -r "$heart_here"/coupled/case/. "$of_cases/$1" &&
    heart_band "$1" mitral "$heart_offset" &&
    heart_python coupled/coupled.py tables "$of_cases/$1" "$of_out/mitral.csv" "$of_out/aortic.csv"
}

# heart_coupled_again NAME [TIME]: copies the files of the coupled run, with its state at this time.
heart_coupled_again() {
  local coupled=$of_cases/coupled
  rm -rf "${of_cases:?}/$1"
  mkdir "$of_cases/$1" && cp -r "$coupled"/{0,constant,system} ${2:+"$coupled/$2"} "$of_cases/$1"
}

# The coupled run at 0.04 s, with both valves closed, continues with the volumes of the 0D model and the same valves.
heart_naive() {
  local naive=$of_cases/naive
  heart_coupled_again naive 0.04 && cp "$heart_here/case/constant/dynamicMeshDict" "$naive/constant" &&
    heart_python coupled/coupled.py naive_tables "$naive" "$of_cases/coupled" 0.04 &&
    cp "$heart_here/case/system/fvSolution" "$naive/system" &&
    foamDictionary "$naive/system/fvOptions" -entry wall -remove -disableFunctionEntries >/dev/null 2>&1 &&
    sed -i '/elastanceTable/d; s/"libelastanceMotion.so"//' "$naive/system/controlDict" &&
    of_set naive system/controlDict endTime 0.12 && of_run naive 1
}

# The coupled run at 0.08 s continues for 20 steps, in which the aortic valve opens: on 2 ranks, and on one rank.
heart_coupled_ranks() {
  local name
  for name in coupled-2 coupled-restart; do
    heart_coupled_again "$name" 0.08 && of_set "$name" system/controlDict endTime 0.12 || return
  done
  of_run coupled-restart 1 &&
    of_logged coupled-2 decomposePar "${of_with[@]}" decomposePar -copyUniform -case "$of_cases/coupled-2" &&
    of_logged coupled-2 pimpleFoam timeout 3600 mpirun -n 2 "${of_with[@]}" pimpleFoam -case "$of_cases/coupled-2" -parallel
}

# heart_coupled_refused NAME WORDS FILE ENTRY VALUE: checks that the coupled case with this entry ends with these words.
heart_coupled_refused() {
  local folder=refused-${1// /_}
  heart_coupled_again "$folder" && of_set "$folder" "$3" "$4" "$5" && of_refused "$1" "$folder" "$2"
}

heart_coupled_refusals() {
  local motion=constant/dynamicMeshDict
  heart_coupled_refused "a negative jump" "jump is -1, and must be positive" "$motion" elastanceMotionCoeffs/jump -1 &&
    heart_coupled_refused "slopes in the wrong order" "leastSlope is 1e+20, and must be below largestSlope" "$motion" \
      elastanceMotionCoeffs/leastSlope 1e20 &&
    heart_coupled_refused "a mesh that stands in the correctors" "moveMeshOuterCorrectors is no" system/fvSolution \
      PIMPLE/moveMeshOuterCorrectors no &&
    heart_coupled_refused "no pressure" "fvOptions has no option of type elastance" system/fvOptions wall/active no
}

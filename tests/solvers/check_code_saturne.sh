#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_code_saturne.sh SOURCE_DIR BUILD_DIR WORK_DIR CMAKE PYTHON
# Runs the closed valve of examples/code_saturne on 1 and 2 ranks, with the riis of a build tree. The script checks the pressure
# drop and the marks. Bad input must stop the solver with a message that names the time step. check.py must refuse bad records.
set -euo pipefail
source=$1 build=$2 work=$3 cmake=$4 python=$5
here=$source/tests/solvers

problem() {
  echo "problem: $*" >&2
  exit 1
}

# Runs a command and shows its output only if it fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { tail -n 60 "$work/log" >&2; problem "failed: $*"; }
}

rm -rf "$work"
mkdir -p "$work"
quietly "$cmake" --install "$build" --prefix "$work/prefix"
# shellcheck source=/dev/null
. "$source/examples/code_saturne/code_saturne.sh"
saturne_environment "$work" "$work/prefix"
export saturne_limit=600
quietly saturne_mesh
quietly saturne_make_study
study=$work/STUDY
quietly saturne_closed 8 20 1 2

check=("$python" -B "$source/examples/code_saturne/check.py")
"${check[@]}" "$study" closed || problem "a check of the closed valve failed"

# refused CASE NAME TEXT [VARIABLE=VALUE...]: the solver must stop and print TEXT.
refused() {
  local case=$1 name=$2 text=$3
  shift 3
  ! saturne_run "$case" "$name" 1 RUN_STEPS=12 "$@" >"$work/log" 2>&1 || problem "$case: $name did not stop"
  cat "$study/$case/RESU/$name"/{listing,error*,run_solver.log} 2>/dev/null | grep -F -- "$text" >/dev/null ||
    { tail -n 20 "$study/$case/RESU/$name"/error* >&2; problem "$case: $name does not say '$text'"; }
  echo "$case: $name stops with '$text'"
}

for case in c fortran; do
  refused "$case" valve_outside "riis: time step 1: the valve leaves the mesh: its z is from" VALVE_Z=0.03
  step=$([[ $case == c ]] && echo 9 || echo 21) # the first step after the checkpoint
  refused "$case" another_kind "riis: time step $step: the checkpoint is of another kind of valve" RUN_STEPS=30 \
    VALVE_KIND=bileaflet RUN_RESTART="$study/$case/RESU/closed_1/checkpoint"
  cp "$here/cs_user_physical_properties.c" "$study/$case/SRC"
  refused "$case" pressures_of_nan "riis: time step 3: RIIS_INVALID_ARGUMENT: pressure_difference is nan"
  rm "$study/$case/SRC/cs_user_physical_properties.c"
done
# Uses a valve of the same kind whose cusps are 0.1 mm lower.
sed -i 's/^  if (cs_restart_present())/  check(riis_valve_set_scalar(valve, "leaflet_height", 1.19));\n&/' \
  "$study/c/SRC/cs_user_valve.c"
sed -i "s/^    if (isuite == 1)/    call valve%set('leaflet_height', 1.19d0)\n&/" "$study/fortran/SRC/cs_user_valve.f90"
for case in c fortran; do
  refused "$case" lower_valve ": the checkpoint is of another valve" RUN_STEPS=30 \
    RUN_RESTART="$study/$case/RESU/closed_1/checkpoint"
done
refused c bad_setting "VALVE_HALF_THICKNESS is '2 mm', but must be a number from" VALVE_HALF_THICKNESS="2 mm"
refused reference no_table "cannot read REFERENCE_CELLS, 'nowhere'" REFERENCE_CELLS=nowhere

# check.py must refuse bad records. Each record is a copy with one fault.
# judged STATUS TEXT FILE SED: check.py must end with STATUS and print TEXT.
judged() {
  local status=0 said
  rm -rf "$work/bad"
  mkdir "$work/bad"
  (cd "$study" && find . -name '*.csv' -not -path '*/monitoring/*' -exec cp --parents {} "$work/bad" \;)
  if [[ $4 == remove ]]; then rm "$work/bad/$3"; else sed -i -E "$4" "$work/bad/$3"; fi
  said=$("${check[@]}" "$work/bad" closed 2>&1) || status=$?
  [[ $status == "$1" && $said == *"$2"* ]] || problem "check.py ends with $status for $3 by $4, and says: $said"
}
judged 2 "history.csv: No such file" fortran/RESU/closed_1/history.csv remove
judged 2 "has upstream 'nan'" c/RESU/closed_1/history.csv '5s/^(([^,]*,){9})[^,]*/\1nan/'
judged 2 "is no list of cells" c/RESU/closed_2/cells_00008.0.csv '3s/,.*//'
judged 1 "FAILED  C, head losses: the drop is" c/RESU/closed_1/history.csv '9s/^(([^,]*,){9})([^,]*)/\11\3/'
judged 1 "FAILED  C, head losses, 2 ranks: the same cells are marked in 7 of 8" c/RESU/closed_2/history.csv \
  '4s/^(([^,]*,){5})[^,]*/\10000000000000000/'
# Changes K of a cell without its centre.
judged 1 "FAILED  C, head losses, 2 ranks: " c/RESU/closed_2/cells_00008.0.csv '3s/[^,]*$/0x1p+3/'
echo "check.py refuses bad records"

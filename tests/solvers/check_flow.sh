#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_flow.sh SOURCE FLOW FLOW_CHECKS MEMBRANE DROP WORK
# Runs the flow solver of examples/flow_fortran on coarse grids. The cases are the solver's checks of itself, a restart with the
# same bits, a cusp of springs, steady drops, plots, and refusals.
set -euo pipefail
source=$1 flow=$2 checks=$3 membrane=$4 drop=$5 work=$6
failed=0
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# Lets Open MPI run as root and without a network, with one rank. Waiting OpenMP threads do not spin.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_plm=isolated OMPI_MCA_btl=self OMPI_MCA_pml=ob1
export OMP_WAIT_POLICY=passive

problem() {
  printf 'problem: %s\n' "$*" >&2
  failed=1
}

# run FOLDER WORD...: runs the solver on a coarse grid, with its files in FOLDER.
run() {
  local folder=$1
  shift
  mkdir -p "$folder/frames"
  "$flow" cells=16 out="'$folder'" "$@" >"$folder/log" 2>&1
}

# refuses TEXT COMMAND...: the command must end with status 1 and print TEXT.
refuses() {
  local text=$1 status=0 output
  shift
  output=$("$@" 2>&1) || status=$?
  if ((status != 1)) || [[ $output != *"$text"* ]]; then
    problem "expected the status 1 and '$text', got $status and: $output"
  fi
}

"$checks" short || problem "a check fails"

# The state is saved at a step at which the valve moves, so that the restart needs the valve's state. Frames are written at other
# steps.
run whole end_time=0.15 frames=5 steps=150 save=140,150 || problem "the solver failed: $(<whole/log)"
run again end_time=0.15 frames=5 steps=150 save=150 restart="'whole/restart_140.bin'" || problem "no restart: $(<again/log)"
awk -F , '$1 == 140 { exit !($4 > 0 && $4 < 1) }' whole/beat.csv || problem "the valve does not move at the restart"
cmp whole/restart_150.bin again/restart_150.bin || problem "after a restart the state differs"
cmp <(sed -n '/^14[1-9],/p; /^150,/p' whole/beat.csv) <(sed 1d again/beat.csv) || problem "after a restart the table differs"

# A closed valve holds: less than 2 ml/s leak at 70 mmHg.
awk -F , '$1 == 20 { found = 1; exit !($4 == 0 && $8 < 0 && $8 > -2e-6 && $7 - $6 > 9000) } END { exit !found }' whole/beat.csv ||
  problem "the closed valve leaks: $(sed -n 21p whole/beat.csv)"

# The flow opens the cusp of springs. After the pressure difference has changed its sign, the flow goes back through the valve.
"$membrane" >membrane.log || problem "the cusp of springs failed"
awk 'NR > 2 { last = $2; if ($1 < 30) opened = $NF } END { exit !(opened > 1 && last < 0) }' membrane.log ||
  problem "the cusp of springs does not follow the flow: $(<membrane.log)"

# Without an offset, a half-open valve has the drop of a narrower valve. With the offset 0.75, the drop of a half-open valve is
# near Bernoulli's. drop_of OFFSET: prints the drop over rho Q^2/(2 A^2), in mmHg and cm2. Leaves the program's output in
# drop_OFFSET.log.
drop_of() {
  "$drop" cells=12 eps=3e-3 opening=0.5 settled=0.1 offset="$1" >"drop_$1.log"
  tail -n 1 "drop_$1.log" | LC_ALL=C awk -F , '{ print $12 / (530 * ($3 / $8 / 100) ^ 2 / 133.322) }'
}
without=$(drop_of 0) with=$(drop_of 0.75)
LC_ALL=C awk -v without="$without" -v with="$with" 'BEGIN { exit !(without > 3 && with > 1 && with < 2) }' ||
  problem "the drop of a half-open valve does not follow the offset: $without, $with"

# The script of the drops computes only rows that its table lacks.
names=$(tail -n 2 drop_0.75.log)
mkdir -p drops
{
  head -n 1 <<<"$names"
  for opening in 0.25 0.5 1.0; do
    for offset in 0.0 0.75; do
      tail -n 1 <<<"$names" |
        awk -F , -v OFS=, -v opening="$opening" -v offset="$offset" '{ $2 = opening; $4 = 24; $6 = 1.5; $7 = offset; print }'
    done
  done
} >drops/runs.csv
/usr/bin/python3 -B "$source/examples/flow_fortran/drops.py" /bin/false drops --short >drops.log 2>&1 ||
  problem "drops.py does not keep its runs: $(<drops.log)"
(($(grep -c '^| trileaflet | ' drops/drops.md) == 6)) || problem "drops.py left another table: $(<drops/drops.md)"
sed -i '$d' drops/runs.csv
refuses "drops.py: /bin/false kind='trileaflet' opening=1.0 flow_rate=250.0 cells=24 eps=1.5e-3 offset=0.75 failed" \
  /usr/bin/python3 -B "$source/examples/flow_fortran/drops.py" /bin/false drops --short

# Bad input must be refused with the following texts.
at_20='flow: step 0, .000000 s: '
refuses "$at_20"'the restart file whole/restart_140.bin is of another run: it has "valve trileaflet", here it is "valve aortic"' \
  "$flow" cells=16 kind="'aortic'" restart="'whole/restart_140.bin'"
refuses 'is of another run: it has "resistance' "$flow" cells=16 resistance=2e4 restart="'whole/restart_140.bin'"
refuses 'is of another run: it has "place' "$flow" cells=16 place=0,0,0.001 restart="'whole/restart_140.bin'"
refuses 'is of another run: it has "cells' "$flow" cells=24 restart="'whole/restart_140.bin'"
refuses "whole/log is no restart file of this program" "$flow" cells=16 restart="'whole/log'"
head -c 30000 whole/restart_140.bin >short.bin
refuses "the restart file short.bin ends too early" "$flow" cells=16 restart="'short.bin'"
refuses "Cannot open file 'nothing.bin'" "$flow" cells=16 restart="'nothing.bin'"
refuses "flow: step 1, .001000 s: the valve leaves the box: it goes from" "$flow" cells=16 place=0,0,0.03 out="'again'"
refuses "flow: step 3, .003000 s: RIIS_INVALID_ARGUMENT: pressure_difference is nan" "$checks" nan
refuses "RIIS_INVALID_PARAMETER: 'pulmonary' is not a kind of valve" "$flow" cells=16 kind="'pulmonary'"
refuses "options: Cannot match namelist object name cels" "$flow" cels=16
refuses "options: cells must be at least 8" "$flow" cells=4
refuses "options: end_time, longest_step and eps_in_cells must be positive" "$flow" end_time=0
refuses 'is of another run: it has "offset' "$flow" cells=16 offset=0.5 restart="'whole/restart_140.bin'"
refuses "RIIS_INVALID_ARGUMENT: options.offset is 1; it must be above -1 and below 1" "$flow" cells=16 offset=1
refuses "options: kind must be 'aortic', 'trileaflet' or 'coapting', not 'mitral'" "$drop" kind="'mitral'"
refuses "options: flow_rate and settled must be positive, most_windows must be at least 3" "$drop" flow_rate=0
refuses "options: cells must be at least 8" "$drop" cells=4
refuses "beat.csv': No such file or directory" "$flow" cells=16 out="'nowhere'"

# Draws the plots, if matplotlib and ffmpeg are installed.
python=/usr/bin/python3
plots=$source/examples/flow_fortran/plots.py
if command -v ffmpeg >/dev/null && "$python" -c 'import matplotlib' 2>/dev/null; then
  "$python" -B "$plots" whole || problem "plots.py failed"
  for file in beat.png flow.mp4; do [[ -s whole/$file ]] || problem "plots.py left no whole/$file"; done
  refuses "there is no file nowhere/beat.csv; the program flow writes it" "$python" -B "$plots" nowhere
  rm whole/frames/0002.bin
  refuses "there is no file whole/frames/0002.bin" "$python" -B "$plots" whole
  head -c 1000 whole/frames/0001.bin >whole/frames/0002.bin
  refuses "whole/frames/0002.bin ends after 1000 bytes" "$python" -B "$plots" whole
else
  echo "matplotlib or ffmpeg was not found: nothing is drawn"
fi
exit "$failed"

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_host.sh FC MODULES INCLUDE WORK FORTRAN_LIBRARY LIBRARY
# Checks the table of flags in docs/building.md. The table says which declarations of a caller in fixed form are right with which
# flags of gfortran. `use riisf` must refuse wrong declarations. Also checks that all names of riis begin with riis.
set -euo pipefail
fc=$1 modules=$2 include=$3 work=$4
libraries=("${@:5}" "-Wl,-rpath,$(dirname "${!#}")")
failed=0
rm -rf "$work"
mkdir -p "$work"
cd "$work"

problem() {
  echo "problem: $*" >&2
  failed=1
}

# source_of INTEGER REAL USE: a program that prints 0.5 if the library gets and gives the value.
source_of() {
  printf '%s\n' '      PROGRAM CALLER' ${3:+"      $3"} '      IMPLICIT NONE' "      INCLUDE 'riisf.h'" \
    "      $1 N, STATUS" "      $2 OPEN(3)" '      REAL(KIND=8) SEEN(1)' '      INTEGER*8 VALVE' \
    '      DATA VALVE /0/, N /1/, OPEN /0.5, -7., -8./, SEEN /-1./' \
    "      CALL RIISF_VALVE_CREATE('aortic', VALVE, STATUS)" \
    "      CALL RIISF_VALVE_SET(VALVE, 'opening', N, OPEN, STATUS)" \
    "      CALL READ(VALVE, SEEN)" \
    "      PRINT '(F5.3)', SEEN(1) + STATUS" '      END' \
    '      SUBROUTINE READ(VALVE, SEEN)' '      INTEGER*4 N, STATUS' '      REAL(KIND=8) SEEN(1)' '      INTEGER*8 VALVE' \
    '      N = 1' "      CALL RIISF_VALVE_GET(VALVE, 'opening', N, SEEN, STATUS)" '      END'
}

# judged WANTED INTEGER REAL FLAGS...: if WANTED is `right`, the caller must compile and print 0.500, with and without `use
# riisf`. If WANTED is `refused`, the caller must not compile with `use riisf`.
judged() {
  local wanted=$1 integer=$2 real=$3 found=refused
  shift 3
  source_of "$integer" "$real" 'USE RIISF' >with.f
  source_of "$integer" "$real" '' >without.f
  if "$fc" -std=legacy "$@" -I "$modules" -I "$include" with.f "${libraries[@]}" -o with >log 2>&1; then
    "$fc" -std=legacy "$@" -I "$include" without.f "${libraries[@]}" -o without
    found=$(./with),$(./without)
    [[ $found != "0.500,0.500" ]] || found=right
  elif ! grep -q 'Type mismatch' log; then
    found=$(<log)
  fi
  [[ $found == "$wanted" ]] || problem "$integer and $real with the flags '$*' are $found, not $wanted"
}

judged right INTEGER 'DOUBLE PRECISION'
judged right 'INTEGER*4' 'REAL*8'
judged refused INTEGER REAL
judged refused INTEGER 'DOUBLE PRECISION' -fdefault-integer-8
judged right 'INTEGER*4' 'DOUBLE PRECISION' -fdefault-integer-8
judged refused INTEGER 'DOUBLE PRECISION' -fdefault-real-8
judged right INTEGER 'REAL*8' -fdefault-real-8
judged right INTEGER REAL -fdefault-real-8
for flags in '-fdefault-real-8 -fdefault-double-8' -freal-4-real-8; do
  for real in REAL 'DOUBLE PRECISION'; do
    # shellcheck disable=SC2086 # several flags
    judged right INTEGER "$real" $flags
  done
done
judged refused INTEGER 'DOUBLE PRECISION' -freal-8-real-16
judged refused INTEGER 'REAL*8' -freal-8-real-16

# Without `use riisf` a wrong kind has no message: the caller compiles, and the library gets another value.
source_of INTEGER REAL '' >unnoticed.f
"$fc" -std=legacy -I "$include" unnoticed.f "${libraries[@]}" -o unnoticed
[[ $(./unnoticed) != 0.500 ]] || problem "REAL is right without use riisf"

# A host may give its variables and procedures any name, if the name does not begin with riis.
others=$(nm -g --defined-only "$5" | awk 'NF == 3 && tolower($3) !~ /riis/ { print $3 }')
[[ ! $others ]] || problem "the library of Fortran defines" "$others"
printf '%s\n' 'program host' '  use riis' '  use riisf' '  use riis_c' '  implicit none' \
  '  integer :: area, d, imesh, mesh, surface, valve, marks, adjacency, x, y, z, k, n, status, list, rank, dt' \
  '  type(riis_valve) :: own' \
  '  area = 1; d = 1; imesh = 1; mesh = 1; surface = 1; valve = 1; marks = 1; adjacency = 1; x = 1; y = 1; z = 1; k = 1' \
  '  n = 1; status = 1; list = 1; rank = 1; dt = 1' \
  "  call own%create('aortic')" '  call finish()' '  call own%destroy()' \
  "  print '(i0)', area + d + imesh + mesh + surface + valve + marks + adjacency + x + y + z + k &" \
  '    + n + status + list + rank + dt' \
  'contains' '  subroutine finish() bind(c)' '  end subroutine' 'end program' \
  'subroutine pass_message() bind(c)' 'end subroutine' 'subroutine fail()' 'end subroutine' >host.f90
"$fc" -I "$modules" -I "$include" host.f90 "${libraries[@]}" -o host
[[ $(./host) == 17 ]] || problem "a host with names of its own prints $(./host)"
((failed)) || echo "the flags and names are as docs/building.md says"
exit "$failed"

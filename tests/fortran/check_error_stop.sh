#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_error_stop.sh PROGRAM
# error_stop.f90 makes errors in calls without a status argument, and copies handles. Each case must print a message on the error
# unit and end with an exit status.
set -euo pipefail
program=$1
failed=0
output=$(mktemp) errors=$(mktemp)
trap 'rm -f "$output" "$errors"' EXIT

# stops CASE TEXT: the program must stop in this case with the text.
stops() {
  if "$program" "$1" >"$output" 2>"$errors"; then
    echo "$1: the program ended without an error" >&2
    failed=1
  elif [ -s "$output" ] || ! grep -q -F "$2" "$errors"; then
    echo "$1: expected \"$2\", got:" >&2
    cat "$output" "$errors" >&2
    failed=1
  fi
}

"$program" none | grep -q 'went on'
stops library 'riis: RIIS_INVALID_PARAMETER: parameter '\''leaflet_angle'\'' is 1000'
stops layer 'riis: RIIS_INVALID_ARGUMENT: the mesh was already created: destroy it first'
stops function 'riis: RIIS_INVALID_ARGUMENT: the object marks was not created, or was destroyed'
stops valve 'riis: a riis_valve cannot be copied'
stops surface 'riis: a riis_surface cannot be copied'
stops keyframes 'riis: a riis_keyframes cannot be copied'
stops law 'riis: RIIS_INVALID_ARGUMENT: times.opening_duration is -1'
stops mesh 'riis: a riis_mesh cannot be copied'
stops adjacency 'riis: a riis_adjacency cannot be copied'
stops result 'riis: a riis_marks cannot be copied'
stops component 'riis: a riis_valve cannot be copied'
stops overwrite 'riis: a riis_valve cannot be overwritten'
exit $failed

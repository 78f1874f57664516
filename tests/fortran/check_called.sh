#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_called.sh HEADER OBJECT_FILES...
# Module riis and the subroutines for Fortran 77 must call every function of the header and of the headers that it includes by
# name. check_procedures.sh checks that the tests call each procedure of the module and each subroutine.
set -euo pipefail
header=$1
mapfile -t headers < <("$(dirname "$0")/../abi/headers.sh" "$header")
shift

functions=$(grep -h -o '^RIIS_API [^(]*(' "${headers[@]}" | grep -o 'riis_[a-z0-9_]*($' | tr -d '(')
if [ "$(wc -l <<<"$functions")" -ne "$(grep -h -v '^#define' "${headers[@]}" | grep -c '\bRIIS_API\b')" ]; then
  echo "$header has declarations that this script does not understand" >&2
  exit 1
fi
# The undefined symbols of the object files are the functions that they call.
called=$(nm -u "$@" | awk '$1 == "U" && $2 ~ /^riis_/ { print $2 }' | sort -u)
uncalled=$(comm -23 <(sort <<<"$functions") <(echo "$called"))
if [ -n "$uncalled" ]; then
  echo "not called by module riis or by a subroutine riisf_*:" "$uncalled" >&2
  exit 1
fi
echo "$(wc -l <<<"$functions") functions"

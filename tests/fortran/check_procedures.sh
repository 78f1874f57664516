#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_procedures.sh SOURCES... -- OBJECT_FILES...
# The Fortran tests must call every public procedure of module riis and every external subroutine. OBJECT_FILES are the tests'
# objects. A procedure is public if a binding, a generic or a PUBLIC statement names it. Each public procedure must have a
# documentation comment.
set -euo pipefail
sources=()
while [ "$1" != -- ]; do
  sources+=("$1")
  shift
done
shift
failed=0

# A procedure is documented if a comment that begins with !> precedes it immediately.
documented=$(awk '
  /^ *!>/ { is_documented = 1; next }
  /^ *!!/ { next }
  is_documented && /^ *(pure |impure |elemental )*(subroutine|function) / {
    sub(/^ *(pure |impure |elemental )*(subroutine|function) /, ""); sub(/\(.*/, ""); print
  }
  { is_documented = 0 }' "${sources[@]}" | grep -v '^riis_log_procedure$' | sort -u) # riis_log_procedure is an abstract interface
named=$(sed 's/!.*//' "${sources[@]}" | sed -n -E 's/^ *procedure(, [a-z_]+)* :: .* => ([a-z0-9_]+) *$/\2/p
  s/^ *module procedure ([a-z0-9_]+) *$/\1/p; s/^subroutine (riisf_[a-z0-9_]+).*/\1/p' | sort -u)
undocumented=$(comm -13 <(echo "$documented") <(echo "$named"))
if [ -n "$undocumented" ]; then
  echo "without documentation:" "$undocumented" >&2
  failed=1
fi

# Undefined symbols are the procedures that are called: __module_MOD_name, or name_ for an external subroutine.
called=$(nm -u "$@" | sed -n -E 's/^ *U (__riis(_[a-z]+)?_MOD_)?([a-z0-9_]+)$/\3/p' |
  sed -E 's/^(riisf_[a-z0-9_]+)_$/\1/' | sort -u)
uncalled=$(comm -23 <(printf '%s\n' "$documented" "$named" | sort -u) <(echo "$called"))
if [ -n "$uncalled" ]; then
  echo "not called by the Fortran tests:" "$uncalled" >&2
  failed=1
fi
echo "$(wc -l <<<"$named") procedures"
exit $failed

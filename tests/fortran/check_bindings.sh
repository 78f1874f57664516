#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_bindings.sh HEADER MODULE_SOURCE OBJECT_FILES...
# The header and the Fortran module have the same functions, structs and constants with the same values, riisf.h beside the
# module has the constants, and every function is called by the objects of the Fortran tests.
set -euo pipefail
header=$1 module=$2
shift 2
failed=0

# compare WHAT HEADER_LINES MODULE_LINES
compare() {
  if [ -z "$2" ] || ! diff <(sort <<<"$2") <(sort <<<"$3"); then
    echo "$1 differ (< $header, > $module)" >&2
    failed=1
  else
    echo "$(wc -l <<<"$2") $1"
  fi
}

functions=$(grep -o '^RIIS_API [^(]*(' "$header" | grep -o 'riis_[a-z0-9_]*($' | tr -d '(')
if [ "$(wc -l <<<"$functions")" -ne "$(grep -v '^#define' "$header" | grep -c '\bRIIS_API\b')" ]; then
  echo "$header has declarations that this script does not understand" >&2
  exit 1
fi
# Name and arguments, such as "riis_mesh_destroy(mesh)", from either language, and the name that Fortran binds to.
# The header without its comments, however many lines they have.
code=$(sed -z -E 's,/\*([^*]|\*+[^*/])*\*+/,,g' "$header")
signatures=$(sed '/^#/d' <<<"$code" | tr '\n' ' ' | grep -o -E 'RIIS_API [^;]*;' |
  sed -E 's/^[^(]*(riis_[a-z0-9_]*)\(/\1(/; s/[^(,]*[ *]([a-z_]+)([,)])/\1\2 /g; s/void\)/)/; s/ *;//; s/ *$//')
bindings=$(sed 's/!.*//' "$module" | sed -n '/^ *interface$/,/^ *end interface$/p' | tr '\n' ' ' | sed 's/& *//g' |
  grep -o -E '(function|subroutine) riis_[a-z0-9_]*\([^)]*\)( result\([a-z]*\))? *bind\(c, name='\''[a-z0-9_]*'\''\)' |
  sed -E "s/^[a-z]* //; s/( result\([a-z]*\))? *bind\(c, name='([a-z0-9_]*)'\)$/ \2/")
compare functions "$(paste -d ' ' <(echo "$signatures") <(echo "$functions"))" "$bindings"

structs=$(grep -o -E '^typedef struct riis_[a-z_]* \{' "$header" | cut -d ' ' -f 3)
types=$(grep -o -E '^ *type, bind\(c\) :: riis_[a-z_]*' "$module" | sed 's/.*:: //')
compare structs "$structs" "$types"

# "struct field type", such as "riis_closest point real(c_double)(3)", from either language. Pointers point to anything.
c_fields=$(awk '
  /^typedef struct riis_[a-z_]* \{/ { struct = $3; next }
  /^\}/ { struct = "" }
  struct != "" && /;/ {
    gsub(/const |;/, ""); gsub(/,/, " ")
    for (i = 2; i <= NF; ++i) {
      name = $i; type = $1; extent = ""
      if (name ~ /^\*/) { type = "type(c_ptr)"; sub(/^\*/, "", name) }
      else if (type == "double") type = "real(c_double)"
      else if (type ~ /^int(32|64)_t$/) type = "integer(c_" type ")"
      if (match(name, /\[.*\]/)) {
        extent = "(" substr(name, RSTART + 1, RLENGTH - 2) ")"
        name = substr(name, 1, RSTART - 1)
      }
      print struct, name, type extent
    }
  }' <<<"$code")
fortran_fields=$(sed 's/!.*//' "$module" | awk '
  /^ *type, bind\(c\) :: / { struct = $4; next }
  /^ *end type/ { struct = "" }
  struct != "" && / :: / {
    type = $1
    sub(/^.* :: /, ""); gsub(/,/, " ")
    for (i = 1; i <= NF; ++i) {
      name = $i; extent = ""
      if (match(name, /\(.*\)/)) { extent = substr(name, RSTART); name = substr(name, 1, RSTART - 1) }
      print struct, name, type extent
    }
  }')
compare fields "$c_fields" "$fortran_fields"

# What test_layout.f90 compares: the fields that the twin lists; it compares their number and their places.
listed=$(tr '\n' ' ' <"$(dirname "$0")/c_twin.c" | grep -o -E 'LAYOUT\(riis_[a-z_]*,( *AT\([a-z_]*\),?)*' |
  awk '{ gsub(/LAYOUT\(|AT\(|[),]/, " "); for (i = 2; i <= NF; ++i) print $1, $i }')
compare "fields of which the place is tested" "$(cut -d ' ' -f 1,2 <<<"$c_fields")" "$listed"

constants=$(grep -o -E '\bRIIS_[A-Z0-9_]+ = -?[0-9]+' "$header")
parameters=$(grep -o -E 'integer\([a-z0-9_]*\), parameter :: RIIS_[A-Z0-9_]+ = -?[0-9]+' "$module" | sed 's/.*:: //')
compare constants "$constants" "$parameters"

# The include file for codes without modules has no log and no surfaces from arrays.
included=$(sed -n -E 's/^ *PARAMETER \((RIIS_[A-Z0-9_]+ = -?[0-9]+)\)$/\1/p' "$(dirname "$module")/riisf.h")
compare "constants of riisf.h" "$(grep -v -E '^RIIS_(LOG|ZERO_AREA)_' <<<"$constants")" "$included"

# What the compiler left undefined is what is really called.
called=$(nm -u "$@" | awk '$1 == "U" && $2 ~ /^riis_/ { print $2 }' | sort -u)
uncalled=$(comm -23 <(sort <<<"$functions") <(echo "$called"))
if [ -n "$uncalled" ]; then
  echo "not called by the Fortran tests:" "$uncalled" >&2
  failed=1
fi
exit $failed

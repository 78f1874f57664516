#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# take_objects.sh BUILD_DIR COMPILER...
# A compiler launcher for a build tree of static libraries. BUILD_DIR is the tree of shared libraries, which was compiled from the
# same sources. Most objects of both trees are equivalent, because all code is position independent and hidden. Only objects that
# export a name differ (RIIS_STATIC in riis/base.h). The script copies objects that export nothing, and compiles the others.
set -euo pipefail
build=$1
shift
object='' rules='' previous=''
for word; do
  case $previous in
    -o) object=$word ;;
    -MF) rules=$word ;;
  esac
  previous=$word
done
taken=$build/$object
if [[ $object != *.o || ! -f $taken ]] || grep -q -E 'GLOBAL +DEFAULT +[0-9]+ riis_' < <(readelf -sW "$taken"); then
  exec "$@"
fi
# The source must be compiled if the build tree had another source. After a build, an object is younger than its source.
if [[ ${!#} -nt $taken ]]; then
  exec "$@"
fi
cp -- "$taken" "$object"
# If the build tree compiles the object again, for example after a change of a header, the object must be copied again.
[[ ! $rules ]] || printf '%s: %s %s\n' "$object" "${!#}" "$taken" >"$rules"

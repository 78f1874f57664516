#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The list has a line "NAME VERSION" for every released function, and a line "NAME = VALUE VERSION" for every constant. VERSION is
# the release that introduced the name. Compiled callers contain these names and values. The list must therefore equal the names
# of the library. The list must also equal the names of the header and of the headers that it includes by name.
set -euo pipefail
list=$1 header=$2 library=$3
mapfile -t headers < <("$(dirname "$0")/headers.sh" "$header")
version=$(sed -n -E 's/^#define RIIS_VERSION_[A-Z]+ ([0-9]+).*/\1/p' "$(dirname "$header")/riis.h" | paste -s -d .)
failed=0

wrong=$(grep -v '^#' "$list" | grep -v -E '^[A-Za-z_0-9]+ (= -?[0-9]+ )?[0-9]+\.[0-9]+\.[0-9]+$' || true)
[ -z "$wrong" ] || { printf '%s: not "NAME [= VALUE] VERSION": %s\n' "$list" "$wrong" >&2; exit 1; }
newest=$(grep -v '^#' "$list" | sed 's/.* //' | sort -V | tail -n 1)
if [ "$(printf '%s\n' "$newest" "$version" | sort -V | tail -n 1)" != "$version" ]; then
  echo "$list: has something since $newest, but this is $version" >&2
  failed=1
fi

# Each symbol carries the symbol version RIIS_1. With another version, the loader would treat it as another symbol.
soname=$(readelf -d "$library" | sed -n -E 's/.*soname: \[lib(riis|riis_vtk)\.so\.([0-9]+)\].*/\1_\2/p')
others=$(nm -D --defined-only "$library" | awk -v node="${soname^^}" '$2 != "A" && $3 !~ "@@" node "$" { print $3 }')
if [ -n "$others" ]; then
  printf 'not under the version %s: %s\n' "${soname^^}" "$others" >&2
  failed=1
fi

listed=$(grep -v '^#' "$list" | sed 's/ [^ ]*$//' | sort)
there=$({
  nm -D --defined-only "$library" | awk '$2 != "A" { sub(/@.*/, "", $3); print $3 }'
  grep -h -o -E '\bRIIS_[A-Z0-9_]+ = -?[0-9]+' "${headers[@]}"
} | sort)
gone=$(comm -23 <(echo "$listed") <(echo "$there"))
new=$(comm -13 <(echo "$listed") <(echo "$there"))
if [ -n "$gone" ]; then
  printf 'programs that were compiled with a release need names that are gone or changed: %s\n' "$gone" >&2
  failed=1
fi
if [ -n "$new" ]; then
  printf 'not in %s; append with the version it comes with (%s): %s\n' "$list" "$version" "$new" >&2
  failed=1
fi
[ $failed -eq 0 ]
echo "$(wc -l <<<"$listed") names"

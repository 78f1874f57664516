#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_exports.sh LIBRARY SONAME HEADER [MORE_NAMES...]
# The shared library must export the functions of the header, those of the headers that it includes by name, and the given names.
# The library must export nothing else.
set -euo pipefail
library=$1 soname=$2 header=$3
mapfile -t headers < <("$(dirname "$0")/../abi/headers.sh" "$header")
shift 3

declared=$(grep -h -o '^RIIS_API [^(]*(' "${headers[@]}" | grep -o 'riis_[a-z0-9_]*($' | tr -d '(')
n_declared=$(wc -l <<<"$declared")
n_api=$(grep -c '\bRIIS_API\b' <(grep -h -v '^#define' "${headers[@]}"))
if [ "$n_declared" -ne "$n_api" ]; then
  echo "$header: $n_api declarations but $n_declared names: this script does not understand one of them" >&2
  exit 1
fi
expected=$(printf '%s\n' "$declared" "$@" | sort)

# Absolute symbols are names of versions, so they do not count as functions.
exported=$(nm -D --defined-only "$library" | awk '$2 != "A" { sub(/@.*/, "", $3); print $3 }' | sort)

if ! diff <(echo "$expected") <(echo "$exported"); then
  echo "$library: < declared but not exported, > exported but not declared" >&2
  exit 1
fi
if ! readelf -d "$library" | grep -q -F "Library soname: [$soname]"; then
  echo "$library: the soname is not $soname" >&2
  readelf -d "$library" | grep SONAME >&2
  exit 1
fi
echo "$n_declared functions, soname $soname"

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_kernels.sh NM SET OBJECT...
# Objects compiled for an instruction set must define their tables of kernels, and no other symbol that the linker sees. Otherwise
# an object might define a function that other objects also define, such as a weak function from a header. The linker could then
# take the copy with instructions that the processor lacks.
set -euo pipefail
nm=$1 set=$2
shift 2
failed=0
for object in "$@"; do
  seen=$("$nm" --defined-only --format=posix "$object" | awk '$2 !~ /^[trdbN]$/ { print $2, $1 }')
  tables=$(grep -c -E "^[DR] .*_kernels_${set}E?\$" <<<"$seen" || true)
  others=$(grep -v -E "^[DR] .*_kernels_${set}E?\$" <<<"$seen" || true)
  if [ "$tables" != 1 ]; then
    printf '%s: %s tables of kernels instead of 1\n' "$object" "$tables" >&2
    failed=1
  fi
  if [ -n "$others" ]; then
    printf '%s: may be taken for others: %s\n' "$object" "$others" >&2
    failed=1
  fi
done
exit $failed

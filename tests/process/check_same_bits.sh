#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_same_bits.sh STATE_DIGESTS DIGESTS
# The bits of 60 states must be those in the file DIGESTS, with every compiler, number of threads and set of instructions, and
# with the C library's code for other processors. Prints the first states that differ. After an intended change of bits, the
# output of STATE_DIGESTS replaces the file.
set -euo pipefail
program=$1 expected=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# glibc then takes its code for processors without FMA and AVX2. Older versions name AVX2_Usable and FMA_Usable.
without_fma=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX2_Usable,-FMA_Usable

failed=0
# compare TEXT COMMAND...
compare() {
  local text=$1
  shift
  "$@" >"$folder/now"
  if cmp -s "$expected" "$folder/now"; then
    echo "$text: the same bits"
  else
    echo "$text: $(diff "$expected" "$folder/now" | grep -c '^>') lines differ, the first ones:" >&2
    diff "$expected" "$folder/now" | head -n 4 >&2 || true
    failed=1
  fi
}
compare "one thread" "$program"
compare "8 threads, baseline instructions" "$program" 8 1
if [[ $("$program" cosine) == "$(GLIBC_TUNABLES=$without_fma "$program" cosine)" ]]; then
  echo "without FMA: not tested, because the C library's own cosine stays the same"
else
  compare "without FMA" env GLIBC_TUNABLES=$without_fma "$program"
fi
exit $failed

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_same_bits.sh STATE_DIGESTS DIGESTS [all]
# The bits of all states and placements must be those of the file DIGESTS. The bits must agree for every compiler, number of
# threads and set of instructions, and for the C library's code for other processors. Prints the first states that differ. With
# the word all, the program runs with each number of threads from 1 to 8 and each set of instructions. Without the word all, the
# program runs only with the extreme numbers and sets. After an intended change of bits, the output of STATE_DIGESTS replaces the
# file.
set -euo pipefail
program=$1 expected=$2 runs=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The settings make glibc use its code for processors without FMA and AVX2. Older versions have the names AVX2_Usable and
# FMA_Usable.
without_fma=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX2_Usable,-FMA_Usable

failed=0
# compare TEXT COMMAND...
compare() {
  local text=$1
  shift
  if ! "$@" >"$folder/now" 2>"$folder/said"; then
    # RIIS_UNAVAILABLE: the processor lacks the requested instructions.
    grep -q UNAVAILABLE "$folder/said" && echo "$text: not tested: $(<"$folder/said")" && return
    echo "$text: $(<"$folder/said")" >&2
    failed=1
  elif cmp -s "$expected" "$folder/now"; then
    echo "$text: the same bits"
  else
    echo "$text: $(diff "$expected" "$folder/now" | grep -c '^>') lines differ, the first ones:" >&2
    diff "$expected" "$folder/now" | head -n 4 >&2 || true
    failed=1
  fi
}
compare "one thread" "$program"
compare "8 threads, baseline instructions" "$program" 8 1
if [[ $runs == all ]]; then
  for n in 2 3 4 5 6 7 8; do compare "$n threads" "$program" "$n"; done
  compare "baseline instructions" "$program" 1 1
  compare "AVX2" "$program" 1 2
  compare "AVX-512" "$program" 1 3
fi
if [[ $("$program" cosine) == "$(GLIBC_TUNABLES=$without_fma "$program" cosine)" ]]; then
  echo "without FMA: not tested, because the C library's own cosine stays the same"
else
  compare "without FMA" env GLIBC_TUNABLES=$without_fma "$program"
  [[ $runs != all ]] || compare "without FMA, 8 threads, baseline instructions" env GLIBC_TUNABLES=$without_fma "$program" 8 1
fi
exit $failed

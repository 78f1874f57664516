#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_functions.sh FILE...
# The core, and a program that contains it, may call only some numerical functions of the C library: those that give the same bits
# on every processor. common/elementary.hpp has sines, arc tangents and similar functions.
set -euo pipefail

# names NM_OPTION FILE
names() { nm -D "$1" "$2" | awk '{ print $NF }' | sed 's/@.*//' | sort -u; }

# An object without optimisation calls some of them where other objects have an instruction (copysign).
same_bits='sqrt|ceil|floor|fmod|remainder|ldexp|frexp|nextafter|nearbyint|rint|round|trunc|fabs|copysign|fmin|fmax|fe[gs]etenv'
for file in "$@"; do
  libm=$(ldd "$file" | awk '/libm\.so/ { print $3 }')
  grep -qx cos <(names --defined-only "$libm") # else the list of functions would be empty
  called=$(comm -12 <(names --undefined-only "$file") <(names --defined-only "$libm"))
  grep -qx sqrt <<<"$called" # the core calls it
  others=$(grep -v -x -E "($same_bits)f?" <<<"$called" || true)
  if [ -n "$others" ]; then
    echo "$file calls functions whose bits depend on the processor: ${others//$'\n'/ }" >&2
    exit 1
  fi
  echo "${file##*/} calls ${called//$'\n'/ }"
done

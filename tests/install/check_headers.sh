#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_headers.sh WORK_DIR CC CXX INCLUDE_DIR HEADER...
# Every public header must compile alone, even if it is included twice. Headers *.h must compile as strict C99 and as C++17, and
# both languages must be able to call them. Headers *.hpp must compile as C++14 to C++23.
set -euo pipefail
work=$1 cc=$2 cxx=$3 include=$4
shift 4
mkdir -p "$work"
for header in "$@"; do
  printf '#include <%s>\n' "$header" "$header" >"$work/alone.c"
  echo 'int main(void) { return riis_last_error()[0]; }' >>"$work/alone.c"
  cp "$work/alone.c" "$work/alone.cpp"
  for optimise in -O0 -O2; do
    [[ $header == *.hpp ]] || "$cc" -std=c99 -pedantic -Wall -Wextra -Wstrict-prototypes -Wconversion -Werror "$optimise" \
      -I"$include" -c "$work/alone.c" -o "$work/alone.o"
    standards=(c++17)
    [[ $header != *.hpp || $optimise != -O0 ]] || standards=(c++14 c++20 c++2b)
    for standard in "${standards[@]}"; do
      "$cxx" -std="$standard" -pedantic -Wall -Wextra -Wconversion -Werror "$optimise" -I"$include" \
        -c "$work/alone.cpp" -o "$work/alone.o"
    done
  done
  # In C++, a mangled name would show that the header lacks extern "C".
  nm -u "$work/alone.o" | grep -q -w riis_last_error
  [[ $header == *.hpp ]] && echo "$header: C++14 to C++23" || echo "$header: C99 and C++17"
done

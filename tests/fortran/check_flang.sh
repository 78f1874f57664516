#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_flang.sh FLANG SOURCE_DIR WORK_DIR LIBRARY
# Compiles the Fortran sources with another compiler, in the way of its users. Links them with the C library that gfortran's tests
# use. The test programs must pass.
set -euo pipefail
flang=$1 source=$2 work=$3 library=$4
flags=(-O0 -Werror)
# shellcheck source=tests/fortran/page_sources.sh
. "$source/tests/fortran/page_sources.sh"
rm -rf "$work"
mkdir -p "$work"
cd "$work"
for name in "${fortran_sources[@]}"; do
  "$flang" "${flags[@]}" -c "$(find "$source/fortran" -name "$name.f90")"
done
link=("$library" "-Wl,-rpath,$(dirname "$library")")
tests=$source/tests/fortran
# The interface intentionally accepts pointers to arrays without the target attribute. flang warns about this.
for name in checks box; do
  "$flang" -O0 -c "$tests/$name.f90"
done
for name in test_calls test_objects test_meshes test_marking test_resistance test_components test_laws test_frames test_f2003 \
    error_stop; do
  "$flang" -O0 "$tests/$name.f90" ./*.o "${link[@]}" -o "$name"
done
for name in test_f77 test_f77_motion test_f77_forces; do
  "$flang" -O0 -I"$source/fortran/generated" "$tests/$name.f" "$tests/f77_checks.f" ./riis*.o "${link[@]}" -o "$name"
done
for name in test_calls test_objects test_meshes test_marking test_resistance test_components test_laws test_frames test_f2003 \
    test_f77 test_f77_motion test_f77_forces; do
  echo "$name"
  "./$name"
done
"$tests/check_error_stop.sh" ./error_stop

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_needed.sh LIBRARY
# The core may link to Embree, TBB, OpenMP and the C and C++ runtimes. Links to anything else, such as VTK or Fortran, are a
# fault. The core must not have a run path.
set -euo pipefail
library=$1
needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\].*/\1/p')
allowed='libembree[34]|libtbb|libgomp|libomp|libstdc\+\+|libc\+\+|libc\+\+abi|libgcc_s|libm|libc|ld-linux[-_a-z0-9]*'
unexpected=$(grep -v -E "^($allowed)\.so" <<<"$needed" || true)
if [ -n "$unexpected" ]; then
  echo "$library needs what it should not:" "$unexpected" >&2
  exit 1
fi
# An empty list of libraries would pass the check above, so the list must contain Embree.
grep -q '^libembree' <<<"$needed"
echo "needed:" "$needed"

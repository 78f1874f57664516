#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# headers.sh HEADER...
# Prints each header and the headers that it includes by name, one per line, in the order in which a compiler reads them. riis.h
# includes all other public headers of the library.
set -euo pipefail
for header in "$@"; do
  echo "$header"
  sed -n -E "s,^#include \"(.*)\"\$,$(dirname "$header")/\1,p" "$header"
done

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_symbols_judged.sh LIBRARY SCRATCH
# check_symbols.sh must refuse a function or constant that was removed, renamed or given another value, in the library or the
# header. The script must also refuse a name that the list lacks.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../.. library=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"

# fails TEXT COMMAND...: the command must fail with an error that has the text.
fails() {
  local text=$1 errors
  shift
  if errors=$("$@" 2>&1); then
    echo "accepted, though: $text" >&2
    exit 1
  fi
  if ! grep -q -F -- "$text" <<<"$errors"; then
    printf 'refused without "%s": %s\n' "$text" "$errors" >&2
    exit 1
  fi
}
# refused TEXT LIST HEADER: check_symbols.sh must fail with an error that has the text.
refused() { fails "$1" "$here/check_symbols.sh" "$2" "$3" "$library"; }
list=$root/abi/riis.symbols header=$root/include/riis/riis.h
"$here/check_symbols.sh" "$list" "$header" "$library"
# gone.symbols has a function that the library lacks, as if the library had dropped this function.
(cat "$list" && echo 'riis_gone 0.1.0') >"$scratch/gone.symbols"
refused 'gone or changed: riis_gone' "$scratch/gone.symbols" "$header"
grep -v '^riis_mesh_create ' "$list" >"$scratch/new.symbols"
version=$(sed -n -E 's/^#define RIIS_VERSION_[A-Z]+ ([0-9]+).*/\1/p' "$header" | paste -s -d .)
refused "($version): riis_mesh_create" "$scratch/new.symbols" "$header"
sed 's/^riis_mesh_create .*/riis_mesh_create 9.0.0/' "$list" >"$scratch/later.symbols"
refused 'has something since 9.0.0' "$scratch/later.symbols" "$header"
cp "$(dirname "$header")"/*.h "$scratch"
sed -i 's/RIIS_SEARCH_PAPER = 3/RIIS_SEARCH_PAPER = 4/' "$scratch/marks.h"
refused 'gone or changed: RIIS_SEARCH_PAPER = 3' "$list" "$scratch/riis.h"

# The check also reads the last header that riis.h includes, so it refuses a value and a function that are planted there.
last=$("$here/headers.sh" "$header" | tail -n 1)
plant() { sed "s|^/\* The phases of a valve|$1\n&|" "$last" >"$scratch/$(basename "$last")"; }
cp "$(dirname "$header")"/*.h "$scratch"
plant 'enum { RIIS_PLANTED = 1 };'
refused "($version): RIIS_PLANTED = 1" "$list" "$scratch/riis.h"
complete=("$here/check_complete.sh" "$here/test_abi.c" "$scratch/riis.h")
fails "RIIS_PLANTED of $scratch/riis.h is not in" "${complete[@]}"
plant 'RIIS_API riis_status riis_planted(int32_t number);'
fails "riis_planted of $scratch/riis.h is not in" "${complete[@]}"
soname=$(readelf -d "$library" | sed -n -E 's/.*soname: \[(.*)\].*/\1/p')
fails '< riis_planted' "$root/tests/install/check_exports.sh" "$library" "$soname" "$scratch/riis.h" riis_component_error
fails riis_planted "$root/tests/fortran/check_called.sh" "$scratch/riis.h" "$library"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# write_symbols.sh FOLDER [check]
# Writes the symbols files of Debian's packages, FOLDER/debian/lib*.symbols, from FOLDER/abi/*.symbols. With `check` it writes
# nothing, and fails if a file is not what it would write.
set -euo pipefail
cd "$1"
major=$(sed -n -E 's/^#define RIIS_VERSION_MAJOR ([0-9]+).*/\1/p' include/riis/riis.h)
status=0
for library in riis riis_vtk; do
  package=lib${library/_/-}$major node=${library^^}_$major file=debian/lib${library/_/-}$major.symbols
  text=$(
    echo "lib$library.so.$major $package #MINVER#"
    echo "* Build-Depends-Package: lib${library/_/-}-dev"
    # Beside each symbol stands the version of the package that introduced it. Constants are not symbols.
    { echo "$node 1.0.0" && grep -E '^riis_[a-z0-9_]+ [0-9.]+$' "abi/$library.symbols"; } | LC_ALL=C sort |
      sed -E "s/^([A-Za-z0-9_]+) (.*)/ \1@$node \2/"
  )
  if [[ ${2:-} != check ]]; then
    echo "$text" >"$file"
  elif ! diff "$file" - <<<"$text"; then
    echo "$file is not what packaging/write_symbols.sh . writes from abi/$library.symbols" >&2
    status=1
  fi
done
exit $status

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_layouts.sh compare DUMP DESCRIBED [LIBRARY]
#   DESCRIBED is the library built with debug information. Callers that were compiled with the dump's release must be able to use
#   it.
#   Every difference that abidiff reports is therefore an error, except new functions and fields at the end of structs.
#   LIBRARY is the library without debug information. If LIBRARY is given, DESCRIBED must export the functions of LIBRARY.
# check_layouts.sh write DUMP DESCRIBED
#   Writes the dump: the exported functions and the public types, without paths of this machine.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
verb=$1 dump=$2 described=$3 library=${4:-}
headers=${RIIS_HEADERS:-$here/../../include/riis}

exported() { nm -D --defined-only "$1" | awk '$2 != "A" { print $3 }' | sort; }

describe() {
  abidw --headers-dir "$headers" --drop-private-types --exported-interfaces-only --drop-undefined-syms \
    --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed "$1"
}

# without_appended_fields DUMP: prints the newer dump on the standard input, without the fields that were appended to the older
# dump's structs. Callers pass the size of the struct for which they were compiled, so later fields do not affect them. (abidiff's
# suppression, has_data_member_inserted_at = end, is not suitable, because it also hides fields whose type changed.)
without_appended_fields() {
  awk '
    function value_of(attribute) {
      if (!match($0, " " attribute "=\047[^\047]*")) return ""
      return substr($0, RSTART + length(attribute) + 3, RLENGTH - length(attribute) - 3)
    }
    { old = FILENAME != "-" }
    /<class-decl / {
      struct = value_of("name")
      n = 0
      if (old) size[struct] = $0
    }
    /<data-member / && ++n > n_fields[struct] && !old && struct in size { dropping = 1 }
    old && /<data-member / { n_fields[struct] = n }
    old { next }
    !dropping { line[++n_lines] = $0 }
    /<class-decl / { first_line = n_lines }
    /<\/data-member>/ && dropping {
      dropping = 0
      line[first_line] = resized(line[first_line], size[struct])
    }
    function resized(new, before) {
      match(before, /size-in-bits=\047[0-9]*/)
      before = substr(before, RSTART, RLENGTH)
      sub(/size-in-bits=\047[0-9]*/, before, new)
      return new
    }
    END { for (i = 1; i <= n_lines; ++i) print line[i] }
  ' "$1" -
}

case $verb in
  write) describe "$described" >"$dump" ;;
  compare)
    if [ ! -s "$dump" ]; then
      echo "there is no $dump to compare with" >&2
      exit 1
    fi
    if [ -n "$library" ] && ! diff <(exported "$described") <(exported "$library"); then
      echo "< exported by the sources that tests/abi/CMakeLists.txt names, > by $library: also put the others there" >&2
      exit 1
    fi
    status=0
    new=$(mktemp)
    trap 'rm -f "$new"' EXIT
    # All 64-bit processors that this project knows have the same struct layouts and sizes. Only the dump's first line names a
    # processor.
    processor=$(head -n 1 "$dump" | grep -o "architecture='[^']*'")
    # The script compares two dumps instead of two libraries. With --headers-dir, abidiff would count all types as private if the
    # other side were a dump without locations.
    describe "$described" | sed "1s/architecture='[^']*'/$processor/" | without_appended_fields "$dump" >"$new"
    report=$(abidiff --no-added-syms "$dump" "$new" 2>&1) || status=$?
    printf '%s\n' "$report"
    if [ $status -ne 0 ]; then
      echo "abidiff says $status: callers compiled with the release of $dump would break" >&2
      exit 1
    fi
    ;;
  *)
    echo "check_layouts.sh: compare or write" >&2
    exit 2
    ;;
esac

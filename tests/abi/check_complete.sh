#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_complete.sh TEST_SOURCE HEADER...
# Every function, enum constant, struct and field of the headers must appear in the test, even if it was appended after a release.
# Headers that these headers include by name are also checked.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
test_source=$1
shift
# Joins each signature into one line.
signatures=$(tr '\n' ' ' <"$test_source" | sed 's/SIGNATURE( */\nSIGNATURE(/g')
missing=0 n=0
for header in "$@"; do
  mapfile -t files < <("$here/headers.sh" "$header")
  functions=$(grep -h -o '^RIIS_API [^(]*(' "${files[@]}" | grep -o 'riis_[a-z0-9_]*($' | tr -d '(')
  constants=$(grep -h -o -E '\bRIIS_[A-Z0-9_]+ = -?[0-9]+' "${files[@]}" | cut -d ' ' -f 1)
  [ -n "$functions" ] && [ -n "$constants" ]
  for name in $functions; do
    n=$((n + 1))
    grep -q "SIGNATURE($name," <<<"$signatures" || {
      echo "$name of $header is not in $test_source" >&2
      missing=1
    }
  done
  for name in $constants; do
    n=$((n + 1))
    grep -q "assert_int_equal($name, " "$test_source" || {
      echo "$name of $header is not in $test_source" >&2
      missing=1
    }
  done
  # Prints "struct" or "struct, field". A comment may span several lines.
  layouts=$(cat "${files[@]}" | sed -z -E 's,/\*([^*]|\*+[^*/])*\*+/,,g' | awk '
    /^typedef struct riis_[a-z_]* \{/ { struct = $3; print struct; next }
    /^\}/ { struct = "" }
    struct != "" && /;/ {
      gsub(/const |\[[0-9]*\]|;/, ""); gsub(/[*,]/, " ")
      for (i = 2; i <= NF; ++i) print struct ", " $i
    }')
  [ -n "$layouts" ]
  while read -r name; do
    n=$((n + 1))
    grep -q -E "(SIZE|FIELD)\($name, [0-9]" "$test_source" || {
      echo "$name of $header is not in $test_source" >&2
      missing=1
    }
  done <<<"$layouts"
done
[ $missing -eq 0 ]
echo "$n names"

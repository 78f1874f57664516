#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_complete.sh TEST_SOURCE HEADER...
# Every function and every enum constant of the headers is pinned by the test, so that what is appended is pinned too.
set -euo pipefail
test_source=$1
shift
# A line each, however they are wrapped.
signatures=$(tr '\n' ' ' <"$test_source" | sed 's/SIGNATURE( */\nSIGNATURE(/g')
missing=0 n=0
for header in "$@"; do
  functions=$(grep -o '^RIIS_API [^(]*(' "$header" | grep -o 'riis_[a-z0-9_]*($' | tr -d '(')
  constants=$(grep -o -E '\bRIIS_[A-Z0-9_]+ = -?[0-9]+' "$header" | cut -d ' ' -f 1)
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
done
[ $missing -eq 0 ]
echo "$n names"

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# expected_of.sh NAME: prints the text that the example NAME must print. It is the part of expected.txt below the line "== NAME".
exec awk -v name="$1" '/^== / { inside = $2 == name; next } inside' "$(dirname -- "$0")/expected.txt"

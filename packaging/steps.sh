# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Functions of the packaging scripts, which read this file, and which set $logs and $rows before they call them.
# shellcheck disable=SC2154 # those two

say() { printf '==> %s\n' "$*"; }

# logged NAME COMMAND...: runs the command with its output in a log in the folder $logs, whose end it shows if the command fails.
# The command runs beside this shell, because a function that is called before || would not end at its first failure.
logged() {
  local name=$1 start=$SECONDS
  shift
  "$@" >"$logs/$name.log" 2>&1 </dev/null &
  wait "$!" || { tail -n 40 "$logs/$name.log" >&2 && exit 1; }
  say "$name: $((SECONDS - start)) s"
}

# row PACKAGE BUILT INSTALLED TESTED SIZE: appends a line to the file $rows, with tabs between. ./run packages prints them as a
# table.
row() { (IFS=$'\t' && printf '%s\n' "$*" >>"$rows"); }

# size FILE: prints its size in kB or MB.
size() { numfmt --to=si --suffix=B --format=%.1f "$(stat -L -c %s "$1")"; }

# same_marks NAME FILE: the file has what a program of tests/install/stranger printed. It must be the same, to the last bit, for
# every kind of installation whose marks are in out/packages. Keeps the file there, as NAME.marks.txt.
same_marks() {
  local other
  (($(wc -l <"$2") > 1000)) || { echo "$1: only $(wc -l <"$2") nodes are marked" >&2; exit 1; }
  for other in out/packages/*.marks.txt; do
    [[ ! -e $other || $other == "out/packages/$1.marks.txt" ]] || cmp "$other" "$2" ||
      { echo "$1: other bits than $other" >&2; exit 1; }
  done
  mkdir -p out/packages
  cp "$2" "out/packages/$1.marks.txt"
}

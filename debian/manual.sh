#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# manual.sh PROGRAM: prints the manual page riis.1, made of the program's own help.
set -eu
program=$1

# Prints text as it is.
verbatim() {
  printf '.nf\n'
  sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/"
  printf '.fi\n'
}

# Prints the names of the commands in a help text.
commands() { sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\)  .*/\1/p'; }

help=$("$program" --help)
printf '.TH RIIS 1 "" "%s" "User Commands"\n' "$("$program" --version)"
printf '.SH NAME\nriis \\- marks the nodes of a mesh near a heart valve\n'
printf '.SH SYNOPSIS\n.B riis\n.I COMMAND\n[\\fIOPTION\\fR]...\n'
printf '.SH DESCRIPTION\n'
printf '%s\n' "$help" | verbatim
printf '.SH COMMANDS\n'
for command in $(printf '%s\n' "$help" | commands); do
  [ "$command" != help ] || continue
  text=$("$program" "$command" --help)
  printf '.SS riis %s\n' "$command" | sed 's/-/\\-/g'
  printf '%s\n' "$text" | verbatim
  for part in $(printf '%s\n' "$text" | commands); do
    printf '.SS riis %s %s\n' "$command" "$part" | sed 's/-/\\-/g'
    "$program" "$command" "$part" --help | verbatim
  done
done
printf '.SH SEE ALSO\n\\fBriis help\\fR lists further topics, and the package riis\\-doc has the documents.\n'

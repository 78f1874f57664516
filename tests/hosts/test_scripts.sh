#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# test_scripts.sh WORK
# The checks of script_checks.sh must notice a wrong status, a wrong output and a changed tree.
set -euo pipefail
# shellcheck source=tests/support/script_checks.sh
. "$(dirname "$0")/../support/script_checks.sh"
work=$1
rm -rf "$work"
made_up "$work" src/core.f src/deep/user.f90
[[ $(<"$work/src/deep/user.f90") == src/deep/user.f90 ]] || problem "made_up made another file"

# noticed TEXT COMMAND...: the check must report a problem with this text.
noticed() {
  local text=$1 said
  shift
  # shellcheck disable=SC2030
  said=$(failed=0; "$@" 2>&1; echo "failed=$failed")
  [[ $said == *"$text"*failed=1 ]] || problem "$*: it says: $said"
}

ends 3 "a word" bash -c 'echo a word; exit 3'
noticed "got 0 and" ends 3 "a word" echo a word
noticed "got 0 and: another" ends 0 "a word" echo another
keeps "$work" true
noticed "it ends with the status 1" keeps "$work" false
noticed "src/core.f" keeps "$work" sh -c "echo ' ' >>'$work/src/core.f'"
noticed "new.f" keeps "$work" touch "$work/new.f"
noticed "link -> src" keeps "$work" ln -s src "$work/link"
noticed "deep/user.f90" keeps "$work" rm "$work/src/deep/user.f90"
# shellcheck disable=SC2031
((failed)) || echo "the checks of scripts notice faults"
# shellcheck disable=SC2031
exit "$failed"

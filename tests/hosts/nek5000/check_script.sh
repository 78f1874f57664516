#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_script.sh SOURCE WORK
# Checks the steps of ./run nek5000 on made-up trees: missing sources, another version, and a copy that is made once.
set -euo pipefail
source=$1 work=$2
# shellcheck source=tests/support/script_checks.sh
. "$source/tests/support/script_checks.sh"
rm -rf "$work"
mkdir -p "$work"
# shellcheck source=examples/nek5000/nek5000.sh
. "$source/examples/nek5000/nek5000.sh"

ends 77 "must hold Nek5000 41d17942 as Nek5000 and gslib 1.0.9 as gslib" nek_check_sources ""
ends 77 "must hold Nek5000" nek_check_sources "$work"
mapfile -t touched < <(awk '{ print $2 }' "$nek_known")
made_up "$work/folder" "${touched[@]}" Nek5000/bin/nekconfig
ends 77 "gslib 1.0.9 as gslib" nek_check_sources "$work/folder"
made_up "$work/folder" gslib/src/gs.c
ends 1 "this is not Nek5000 41d17942" nek_check_sources "$work/folder"
ends 1 "Nek5000/core/plan4.f: FAILED" nek_check_sources "$work/folder"

(cd "$work/folder" && sha256sum "${touched[@]}") >"$work/known.sha256"
nek_known=$work/known.sha256
ends 0 "" nek_check_sources "$work/folder"
nek_work=$work/build
keeps "$work/folder" nek_copy "$work/folder"
[[ -f $nek_work/Nek5000/3rd_party/gslib/gslib/src/gs.c ]] || problem "gslib is not in the copy"
echo compiled >"$nek_work/Nek5000/bin/genbox"
keeps "$work" nek_copy "$work/folder"
for file in "${touched[@]}"; do
  printf '\n' >>"$work/folder/$file"
  ends 1 "$file: FAILED" nek_check_sources "$work/folder"
  printf '%s\n' "$file" >"$work/folder/$file"
done
((failed)) || echo "the script refuses what it does not know, and copies once"
exit "$failed"

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# expand_templates.sh [FOLDER]
# Expands templates/riis_*.fypp, and writes riisf.f90 (interfaces.py), into FOLDER/riis_*.f90, by default generated/ beside this
# script. Needs fypp (Debian's package fypp).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$(cd "${1:-$here/generated}" && pwd)
if ! command -v fypp >/dev/null; then
  echo "expand_templates.sh: fypp was not found; Debian has it as the package fypp" >&2
  exit 1
fi
for template in "$here"/templates/riis_*.fypp; do
  source=$folder/$(basename "$template" .fypp).f90
  # What comes out is read by people: lines are as long as the template makes them, and whole or not there.
  fypp --no-folding "$template" "$source.part"
  mv "$source.part" "$source"
done
python3 -B "$here/interfaces.py" "$folder"

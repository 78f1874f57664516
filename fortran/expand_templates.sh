#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# expand_templates.sh [FOLDER]
# Expands each templates/riis_*.fypp into FOLDER/riis_*.f90. FOLDER is generated/ beside this script by default. Needs fypp
# (Debian's package fypp).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$(cd "${1:-$here/generated}" && pwd)
if ! command -v fypp >/dev/null; then
  echo "expand_templates.sh: fypp was not found; Debian has it as the package fypp" >&2
  exit 1
fi
for template in "$here"/templates/riis_*.fypp; do
  source=$folder/$(basename "$template" .fypp).f90
  # People read the generated files, so --no-folding keeps the templates' line breaks. A file is replaced only when complete.
  PYTHONDONTWRITEBYTECODE=1 fypp --no-folding -M "$here/bindings" -m structs "$template" "$source.part"
  mv "$source.part" "$source"
done

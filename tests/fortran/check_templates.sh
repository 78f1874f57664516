#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_templates.sh FORTRAN_FOLDER SCRATCH
# The generated sources must equal the expanded templates and fit the line length. The comparison must refuse damaged copies. The
# test is skipped (77) if fypp is not installed.
set -euo pipefail
folder=$1 scratch=$2
if ! command -v fypp >/dev/null; then
  echo "skipped: fypp was not found, so the generated Fortran sources are not compared with their templates"
  exit 77
fi

# check FOLDER: succeeds if the sources in FOLDER equal the expanded templates in FOLDER.
check() {
  local name status=0
  rm -rf "$scratch/expanded"
  mkdir -p "$scratch/expanded"
  "$1/expand_templates.sh" "$scratch/expanded" || return 1
  for name in $(cd "$scratch/expanded" && ls); do
    if ! diff -u "$1/generated/$name" "$scratch/expanded/$name"; then
      echo "$name is not what its template expands to: edit the template, then run fortran/expand_templates.sh"
      status=1
    fi
  done
  for name in $(cd "$1/generated" && grep -l '^! Generated from fortran/templates/' ./*.f90); do
    if [ ! -e "$scratch/expanded/$name" ]; then
      echo "$name says that it is generated, and has no template"
      status=1
    fi
  done
  if ! awk 'length > 130 { print FILENAME ":" FNR ": " length " columns; at most 130"; long = 1 } END { exit long }' \
      "$1"/templates/*.fypp "$scratch"/expanded/*.f90; then
    status=1
  fi
  return "$status"
}

# refused TEXT: `check` must refuse $scratch/fortran with an error that contains TEXT.
refused() {
  local errors
  if errors=$(check "$scratch/fortran" 2>&1); then
    echo "accepted, though: $1" >&2
    exit 1
  fi
  if ! grep -q -F -- "$1" <<<"$errors"; then
    printf 'refused without "%s": %s\n' "$1" "$errors" >&2
    exit 1
  fi
}

# The damaged copies need only three sources and their templates, and the headers.
copy() {
  local name
  rm -rf "$scratch/fortran" "$scratch/include"
  mkdir -p "$scratch/fortran/templates" "$scratch/fortran/generated"
  cp -r "$folder/../include" "$scratch"
  cp -r "$folder/bindings" "$folder/expand_templates.sh" "$scratch/fortran"
  cp "$folder/templates/kinds.fypp" "$scratch/fortran/templates"
  for name in riis_meshes riis_frames riis_crossing; do
    cp "$folder/generated/$name.f90" "$scratch/fortran/generated"
    cp "$folder/templates/$name.fypp" "$scratch/fortran/templates"
  done
}

check "$folder" >&2
ls "$scratch/expanded"
copy
check "$scratch/fortran" >&2
sed -i 's/must be one more/must be more/' "$scratch/fortran/generated/riis_meshes.f90"
refused 'riis_meshes.f90 is not what its template expands to'
copy
sed -i 's/must be one more/must be more/' "$scratch/fortran/templates/riis_meshes.fypp"
refused 'riis_meshes.f90 is not what its template expands to'
copy
rm "$scratch/fortran/templates/riis_meshes.fypp"
refused 'riis_meshes.f90 says that it is generated, and has no template'
copy
sed -i 's|^} riis_crossing_list;|  double planted; /* planted */\n&|' "$scratch/include/riis/queries.h"
refused '+    real(c_double) :: planted = 0                           !< Planted.'
copy
echo '#:endfor' >>"$scratch/fortran/templates/riis_meshes.fypp"
refused "riis_meshes.fypp:$(wc -l <"$scratch/fortran/templates/riis_meshes.fypp"): error:"
copy
printf '! %130d\n' 0 >>"$scratch/fortran/templates/riis_meshes.fypp"
"$scratch/fortran/expand_templates.sh"
refused '132 columns; at most 130'

# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Reads the list of docs/building.md, "What is installed", into fortran_sources. The list has the names of the Fortran sources in
# the order in which they use each other. Tests compile this list, so the users' list is tested. `source` is the source folder.
mapfile -t fortran_sources < <(sed -n '/^for name in riis_c /,/; do$/p' "$source/docs/building.md" |
  sed 's/^for name in//; s/; do$//; s/\\$//' | xargs -n 1)
((${#fortran_sources[@]} > 0)) || { echo "docs/building.md has no list of Fortran sources" >&2; exit 1; }

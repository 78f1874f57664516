#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_documented.sh DOXYGEN SOURCE_DIR SCRATCH
# Every public function, struct, field, value, macro and typedef of the C headers must have a description in Doxygen's output. The
# names come from the headers, so the check also finds names that Doxygen overlooks. Copies of the headers, each without one
# comment, then show that the check can fail.
set -euo pipefail
doxygen=$1 source=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$source"

# names HEADER...: prints "name" or "struct.field", one per line.
names() {
  cat "$@" | sed -z -E 's,/\*([^*]|\*+[^*/])*\*+/,,g' | awk '
    /^#define RIIS_[A-Z_]*_H$/ { next } # include guards
    /^#define RIIS_/ { print $2 }
    /^RIIS_API / { match($0, /riis_[a-z_0-9]*\(/); print substr($0, RSTART, RLENGTH - 1) }
    /^typedef struct riis_[a-z_]* \{/ { struct = $3; print struct }
    /^typedef struct riis_[a-z_]* riis_[a-z_]*;/ { print $3 }
    /^typedef [a-z0-9_]* riis_[a-z_]*;/ { sub(/;/, ""); print $3 }
    /^typedef .*\(\*riis_/ { match($0, /\(\*riis_[a-z_]*/); print substr($0, RSTART + 2, RLENGTH - 2) }
    /^\}/ { struct = "" }
    struct != "" && /^  .*;/ {
      gsub(/const |\[[0-9]*\]|;/, ""); gsub(/[*,]/, " ")
      for (i = 2; i <= NF; ++i) print struct "." $i
    }
    {
      for (line = $0; match(line, /RIIS_[A-Z_0-9]+ = /); line = substr(line, RSTART + RLENGTH))
        print substr(line, RSTART, RLENGTH - 3)
    }
  ' | sort -u
}

# documented DIRECTORY: prints the names that have a description in that directory's XML files.
documented() {
  cat "$1"/*.xml | awk '
    function begin(what) { kind[++depth] = what; name[depth] = ""; text[depth] = 0 }
    function end() {
      if (text[depth]) {
        if (kind[depth] == "variable") print name[depth - 1] "." name[depth]
        else print name[depth]
      } else if (kind[depth] == "enum") print "the enum of " first_value
      --depth
    }
    /<compounddef / { begin("compound") }
    /<memberdef / { match($0, /kind="[a-z]*"/); begin(substr($0, RSTART + 6, RLENGTH - 7)); first_value = "" }
    /<enumvalue / { begin("value") }
    depth && name[depth] == "" && /<(compound)?name>/ {
      name[depth] = $0
      gsub(/^.*<(compound)?name>|<\/(compound)?name>.*$/, "", name[depth])
      if (kind[depth] == "value" && first_value == "") first_value = name[depth]
    }
    /<(brief|detailed)description>/ { describes = 1 }
    describes && depth && /<para>/ { text[depth] = 1 }
    /<\/(brief|detailed)description>/ { describes = 0 }
    /<\/(enumvalue|memberdef|compounddef)>/ { end() }
  ' | sort -u
}

# undocumented DIRECTORY HEADER...: prints the names without a description. Doxygen writes its files into DIRECTORY.
undocumented() {
  local to=$1
  shift
  mkdir -p "$to"
  (
    cat docs/reference/Doxyfile
    printf '%s\n' "INPUT = $*" "OUTPUT_DIRECTORY = $to" 'GENERATE_HTML = NO' 'GENERATE_XML = YES' 'WARNINGS = NO' \
      'GENERATE_TAGFILE =' # the file of ./run docs stays as it is
  ) | "$doxygen" - >"$to/log" 2>&1 || { cat "$to/log" >&2; return 1; }
  documented "$to/xml" >"$to/documented"
  comm -23 <(names "$@") "$to/documented"
  grep '^the enum of' "$to/documented" || true
}

mapfile -t headers < <(tests/abi/headers.sh include/riis/riis.h include/riis/riis_vtk.h)
n=$(names "${headers[@]}" | wc -l)
missing=$(undocumented "$scratch/all" "${headers[@]}")
if [ -n "$missing" ]; then
  echo "not documented: ${missing//$'\n'/, }" >&2
  exit 1
fi

# without HEADER BEFORE AFTER NAME: removes the comment between BEFORE and AFTER from the header. Afterwards the check must report
# NAME.
without() {
  local header=include/riis/$1 before=$2 after=$3 expected=$4 to=$scratch/mutated found
  rm -rf "$to"
  mkdir -p "$to"
  sed -z -E "s~($before)/\*([^*]|\*+[^*/])*\*+/($after)~\1\3~" "$header" >"$to/${header##*/}"
  if cmp -s "$header" "$to/${header##*/}"; then
    echo "$header has no comment between '$before' and '$after' any more: this script is out of date" >&2
    exit 1
  fi
  found=$(undocumented "$to" "$to/${header##*/}")
  if [ "$found" != "$expected" ]; then
    printf 'without its comment only %s should have been found, but this was:\n%s\n' "$expected" "$found" >&2
    exit 1
  fi
}
without mesh.h '\n' '\nRIIS_API riis_status riis_mesh_create\(' riis_mesh_create
without mesh.h '\n' '\ntypedef struct riis_csr \{' riis_csr
without valve.h 'double \*control; *' '\n' riis_patches.control
without surface.h 'void \*vx, \*vy, \*vz; *' '\n' 'riis_surface_arrays.vx
riis_surface_arrays.vy
riis_surface_arrays.vz'
without base.h 'RIIS_INVALID_MESH = 5, *' '\n' RIIS_INVALID_MESH
without marks.h '\n' '\nenum \{\n  RIIS_SEARCH_AUTO' 'the enum of RIIS_SEARCH_AUTO'
without queries.h '\n' '\n#define RIIS_FAR_DISTANCE' RIIS_FAR_DISTANCE
without base.h '\n' '\ntypedef void \(\*riis_log_function' riis_log_function
without mesh.h '\n' '\ntypedef struct riis_mesh riis_mesh' riis_mesh
# The last header is also read.
without laws.h '\n' '\nRIIS_API riis_status riis_opening_angle_advance\(' riis_opening_angle_advance
echo "$n names"

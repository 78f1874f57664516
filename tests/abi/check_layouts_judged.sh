#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_layouts_judged.sh CC SCRATCH
# Runs check_layouts.sh on a tiny library and on changed copies of it. The check must accept changes that do not affect compiled
# callers, and refuse all other changes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cc=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/first" "$scratch/next"

cat >"$scratch/first/riis_small.h" <<'TEXT'
#include <stdint.h>
typedef struct riis_handle riis_handle;
typedef enum riis_choice { RIIS_FIRST = 0, RIIS_SECOND = 1 } riis_choice;
typedef struct riis_options {
  int64_t struct_size;
  double limit;
  int32_t n_threads;
  int32_t reserved;
} riis_options;
int32_t riis_create(const riis_options *options, riis_choice choice, riis_handle **handle);
int32_t riis_destroy(riis_handle **handle);
TEXT
cat >"$scratch/first/small.c" <<'TEXT'
#include "riis_small.h"
int32_t riis_create(const riis_options *options, riis_choice choice, riis_handle **handle) { return !options + choice + !handle; }
int32_t riis_destroy(riis_handle **handle) { return !handle; }
TEXT

# build DIRECTORY
build() {
  "$cc" -shared -fPIC -g -O0 -Wl,-soname,libsmall.so.0 -o "$1/libsmall.so" "$1/small.c"
}
build "$scratch/first"
RIIS_HEADERS=$scratch/first "$here/check_layouts.sh" write "$scratch/small.xml" "$scratch/first/libsmall.so"
if grep -q -F "$scratch" <(sed 's/path=.[^ ]*//' "$scratch/small.xml"); then
  echo "the dump has a path of this machine in it" >&2
  exit 1
fi

# release accepted|refused TEXT EDIT: applies the sed script EDIT to both files. The check's report must contain TEXT.
release() {
  local expected=$1 text=$2 edit=$3 found=accepted report
  cp "$scratch"/first/*.[ch] "$scratch/next"
  sed -i -E "$edit" "$scratch"/next/*.[ch]
  build "$scratch/next"
  report=$(RIIS_HEADERS=$scratch/next "$here/check_layouts.sh" compare "$scratch/small.xml" "$scratch/next/libsmall.so" 2>&1) ||
    found=refused
  if [ $found != "$expected" ] || ! grep -q -F -- "$text" <<<"$report"; then
    printf '"%s" was %s; expected was %s, with "%s":\n%s\n' "$edit" "$found" "$expected" "$text" "$report" >&2
    exit 1
  fi
}
release accepted '' 's/^$//'
release accepted '' 's/^int32_t riis_destroy.*;$/&\nint32_t riis_added(int32_t n);/
  s/^int32_t riis_destroy.*\}$/&\nint32_t riis_added(int32_t n) { return n; }/'
release accepted '' 's/^  int32_t reserved;/&\n  double appended;/'
release accepted '' 's/^  int32_t reserved;/&\n  double appended, another;\n  const char *third;/'
release refused "riis_options" 's/^  double limit;/&\n  double inserted;/'
release refused "riis_options" 's/^  double limit;/&\n  double inserted;/; s/^  int32_t reserved;/&\n  double appended;/'
release refused "riis_options" 's/^  double limit;//'
release refused "riis_options" 's/^  double limit;/  int64_t limit;/'
release refused "riis_options" 's/^  int32_t n_threads;/  int32_t place;/
  s/^  int32_t reserved;/  int32_t n_threads;/
  s/ place;/ reserved;/'
release refused "riis_options" 's/^  int32_t reserved;//; s/^  int32_t n_threads;/  int64_t n_threads;/'
release refused "RIIS_SECOND" 's/RIIS_SECOND = 1/RIIS_SECOND = 2/'
release refused "RIIS_SECOND" 's/, RIIS_SECOND = 1//'
release refused "riis_destroy" '/^int32_t riis_destroy/d'
release refused "riis_destroy" 's/riis_destroy/riis_dispose/'
release refused "riis_create" 's/riis_choice choice/int64_t choice/'
echo "judged as they should be"

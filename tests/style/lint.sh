#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh SOURCE_FOLDER PART...
# Checks the style of all files that git tracks, or of all files if the folder is not a git work tree. The parts:
#   format   C and C++ is laid out as clang-format 14 does; the public headers are laid out by hand
#   shell    shellcheck reports nothing; `run` does without the features of bash 4; a script without #! is checked as part of
#            the script that reads it; status 77 if RIIS_LINTED says that ./run lint has just found nothing
#   columns  no line is too long (check_columns.py)
#   python   pyflakes reports nothing
#   includes each file of the core compiles alone, though other builds read the core in batches or with a precompiled header
#   tidy     clang-tidy 14 (.clang-tidy) reports nothing in the files of build-lint/compile_commands.json; each name of a
#            using-declaration is used
#   clang    clang warns of nothing in the benchmarks, examples and tests; ./run sanitize compiles the core's tests by clang
#   tools    the programs for the other parts are installed; status 77 if one is missing or of another version
# shellcheck disable=SC2317 # the parts are called by their names
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
cd "$1"
shift
python=python3
[[ ! -x /usr/bin/python3 ]] || python=/usr/bin/python3 # Debian's own Python has the packages

# needs PACKAGE VERSION COMMAND...: the command must print the version.
needs() {
  local package=$1 version=$2 said
  shift 2
  said=$("$@" 2>&1) || said="there is no $1"
  [[ $said == *"$version"* ]] || {
    printf "%s is needed, version %s, as Debian 12's package %s has it: %s\n" "$1" "$version" "$package" "${said%%$'\n'*}" >&2
    exit 77
  }
}

tools() {
  needs clang-format-14 'version 14.' clang-format-14 --version
  needs clang-tidy-14 'version 14.' clang-tidy-14 --version
  needs shellcheck 'version: 0.9.' shellcheck --version
  needs python3-pyflakes '2.5.' "$python" -m pyflakes --version
}

files=()
while IFS= read -r -d '' file; do
  [[ ! -f $file || -L $file ]] || files+=("$file")
done < <(if [[ -e .git ]]; then git ls-files -z; else
  find . \( -path './build*' -o -path ./out \) -prune -o -type f -printf '%P\0'; fi)

# ending REGEX: sets `found` to the files whose names match.
ending() {
  local file
  found=()
  for file in "${files[@]}"; do
    [[ ! $file =~ $1 ]] || found+=("$file")
  done
}

format() {
  local file laid_out=()
  ending '\.(c|h|cpp|hpp|C|H)$'
  for file in "${found[@]}"; do
    [[ $file == include/riis/*.h || $file == */riisf.h ]] || laid_out+=("$file") # riisf.h is Fortran
  done
  found=("${laid_out[@]}")
  clang-format-14 --dry-run -Werror "${found[@]}"
}

shell() {
  [[ ! ${RIIS_LINTED:-} ]] || exit 77
  local file first scripts=() readers status=0
  ending '(\.sh|(^|/)run)$'
  readers=("${found[@]}")
  for file in "${files[@]}"; do
    first=
    IFS= read -r -n 40 first <"$file" 2>/dev/null || true
    if [[ $first =~ ^\#!.*[/\ ](ba|da)?sh$ ]]; then
      scripts+=("$file")
    elif [[ $file == *.sh ]] && ! grep -qsE -- "(shellcheck source=|^\. )$file( |\$)" "${readers[@]}"; then
      echo "$file has no #!, and no script reads it" >&2
      status=1
    fi
  done
  # macOS has bash 3.2. `run` must start in bash 3.2, before `run` can refuse this version.
  ! grep -snE 'mapfile|readarray|(declare|local) -[An]|\$\{[a-z_]+(,|\^)|&>>|\|&|coproc|;;&|wait -n' run |
    sed 's/^/bash 3.2 lacks: run:/' | grep . >&2 || status=1
  # Scripts that `run` reads are checked together with `run`, because they use its variables.
  [[ ! -e run ]] || shellcheck --check-sourced -x -P . run || status=1
  printf '%s\0' "${scripts[@]}" | xargs -0 -P "$(nproc)" -n 8 shellcheck -x -P . || status=1
  found=("${scripts[@]}")
  return "$status"
}

columns() {
  found=("${files[@]}")
  "$python" -B "$here/check_columns.py" "${files[@]}"
}

python() {
  ending '\.py$'
  "$python" -m pyflakes "${found[@]}"
}

includes() {
  mapfile -t found < <(sed -nE 's/^#include "(.*)"$/\1/p' build-lint/src/riis/CMakeFiles/riis_objects.dir/Unity/*.cxx)
  printf '%s\0' "${found[@]}" | LC_ALL=C xargs -0 -P "$(nproc)" -n 4 \
    g++ -std=c++17 -fopenmp -DRIIS_X86_KERNELS -Iinclude -Isrc/riis -Isrc -w -fsyntax-only
}

# In batches of files, clang-tidy does not find unused using-declarations.
usings() {
  local file name status=0
  ending '^(src|bench)/.*\.cpp$'
  for file in "${found[@]}"; do
    while read -r name; do
      (($(grep -cw "$name" "$file") > 1)) || { echo "$file: the name $name of a using-declaration is not used" >&2; status=1; }
    done < <(sed -nE 's/^ *using [A-Za-z_:]*::([A-Za-z_]+);$/\1/p' "$file")
  done
  return "$status"
}

# compiled_files: prints the files of build-lint/compile_commands.json that are in this folder.
compiled_files() { sed -nE 's/^ *"file": "(.*)",?$/\1/p' build-lint/compile_commands.json | sed -n "s|^$PWD/||p" | sort -u; }

# The programs of ./run figures and the study of accuracy are read like the library.
of_bench='^bench/(accuracy/accuracy|(peers|proofs|scale|shared|stages|steps)/)'
of_tests='^(build-lint/)?(examples|tests)/'
of_sanitize='^tests/(geometry|install|marking|process|support|surface)/'

# warned FLAG...: reads the files that are named on standard input. clang-tidy needs a check beside clang's warnings.
warned() {
  tr '\n' '\0' | xargs -0 -r -P "$(nproc)" -n 1 clang-tidy-14 -p build-lint --quiet \
    --header-filter="^$PWD/(bench|examples|tests)/" --checks='-*,clang-diagnostic-*,modernize-use-override' "$@" >&2 2>/dev/null
}

clang() {
  local status=0
  mapfile -t found < <(compiled_files | grep -E "$of_bench|$of_tests" | grep -v -E "$of_sanitize")
  # If a standard is gcc's default, CMake gives no option for it. The default of clang 14 differs.
  printf '%s\n' "${found[@]}" | sed '/\.c$/d' | warned --extra-arg=-std=gnu++17 || status=1
  printf '%s\n' "${found[@]}" | sed -n '/\.c$/p' | warned || status=1
  return "$status"
}

tidy() {
  local status=0 faults
  usings || status=1
  mapfile -t found < <(compiled_files | grep -v -E "$of_bench|$of_tests")
  # In a unity build a batch file includes the sources, so clang-tidy treats them as headers.
  faults=$(printf '%s\0' "${found[@]}" |
    xargs -0 -P "$(nproc)" -n 1 clang-tidy-14 -p build-lint --quiet --header-filter="^$PWD/(src|include)/" 2>/dev/null) ||
    status=$?
  [[ ! $faults ]] || awk '!seen[$0]++' <<<"$faults" >&2
  return "$status"
}

# check PART: runs the part and says how it ended.
check() {
  local part=$1 start=$SECONDS found=()
  if ! "$part"; then
    echo "$part: faults, see above" >&2
    return 1
  fi
  [[ $part != tools ]] || return 0
  ((${#found[@]})) || { echo "$part: there are no files" >&2; return 1; }
  echo "$part: fine, ${#found[@]} files, $((SECONDS - start)) s"
}

# All parts run at the same time, because some of them use only one processor. The output of the parts is printed in turn.
said=$(mktemp -d)
trap 'rm -rf "$said"' EXIT
declare -A running=()
for part; do
  check "$part" >"$said/$part" 2>&1 &
  running[$part]=$!
done
failed=0
for part; do
  wait "${running[$part]}" || failed=$?
  cat "$said/$part"
done
exit "$failed"

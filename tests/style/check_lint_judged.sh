#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_lint_judged.sh SOURCE_FOLDER SCRATCH_FOLDER
# Each part of lint.sh must accept a small project, and refuse a fault that is planted there.
set -euo pipefail
unset RIIS_LINTED # lint.sh must check here, even if .ci/run has
lint=$(readlink -f "$(dirname "$0")")/lint.sh
sources=$(readlink -f "$1") scratch=$2

# plant: makes a project with one file of each language. The project contains long lines that are allowed.
plant() {
  local long
  rm -rf "$scratch"
  mkdir -p "$scratch"/{src,bench/steps,tests/cli} "$scratch/build-lint/src/riis/CMakeFiles/riis_objects.dir/Unity"
  cd "$scratch"
  cp "$sources/.clang-format" "$sources/.clang-tidy" .
  printf -v long '%0150d' 0
  printf '#include <string>\n\nstd::string twice(const std::string &text) { return text + text; }\n' >src/twice.cpp
  printf 'constexpr int n_steps = 2;\nstatic_assert(n_steps > 1);\n' >bench/steps/steps.cpp
  printf 'int main(void) { return 0; }\n' >tests/cli/test_none.c
  printf '[{"directory": "%s",\n  "command": "%s",\n  "file": "%s/src/twice.cpp"\n},\n' \
    "$PWD" "c++ -std=c++17 -Wall -Wextra -c src/twice.cpp" "$PWD" >build-lint/compile_commands.json
  printf '{"directory": "%s",\n  "command": "%s",\n  "file": "%s/bench/steps/steps.cpp"\n},\n' \
    "$PWD" "c++ -Wall -Wextra -c bench/steps/steps.cpp" "$PWD" >>build-lint/compile_commands.json
  printf '{"directory": "%s",\n  "command": "%s",\n  "file": "%s/tests/cli/test_none.c"\n}]\n' \
    "$PWD" "cc -std=c11 -Wall -Wextra -c tests/cli/test_none.c" "$PWD" >>build-lint/compile_commands.json
  echo "#include \"$PWD/src/twice.cpp\"" >build-lint/src/riis/CMakeFiles/riis_objects.dir/Unity/unity_0_cxx.cxx
  # shellcheck disable=SC2016 # the planted scripts' own variables
  printf '#!/bin/bash\n# shellcheck source=steps.sh\n. steps.sh\nstep "$1"\n' >run
  # shellcheck disable=SC2016
  printf '# shellcheck shell=bash\nstep() { printf "%%s\\n" "$1"; }\n' >steps.sh
  printf 'import sys\n\nprint(sys.argv)\n' >tool.py
  printf 'C     %066d\n' 0 >fixed.f
  # shellcheck disable=SC2016 # marks of a document's block
  printf '| %s |\n\n<!-- %s -->\n\n- [link](%s)\n\n```text\n%s\n```\n\n    %s\n' "$long" "$long" "$long" "$long" "$long" >page.md
}

accepts() {
  "$lint" . "$1" || { echo "$1: refused" >&2; exit 1; }
}

# refuses PART MESSAGE: the part must fail with this message. The project is then planted anew.
refuses() {
  local said
  if said=$("$lint" . "$1" 2>&1); then
    echo "$1: not refused: $2" >&2
    exit 1
  fi
  [[ $said == *"$2"* ]] || { echo "$1: '$said' lacks '$2'" >&2; exit 1; }
  plant
}

# A missing program is named together with its package.
mkdir -p "$scratch"
other_version=$(
  # shellcheck disable=SC2317 # lint.sh calls it
  clang-format-14() { echo "version 13.0"; }
  export -f clang-format-14
  "$lint" "$sources" tools 2>&1
) && { echo "tools: another version was not refused" >&2; exit 1; }
[[ $other_version == *"as Debian 12's package clang-format-14 has it: version 13.0"* ]] || {
  echo "tools: '$other_version' does not name package and version" >&2
  exit 1
}
"$lint" "$sources" tools

plant
for part in format shell columns python includes tidy clang; do accepts "$part"; done
echo 'int  f( ){return 0;}' >>src/twice.cpp
refuses format 'src/twice.cpp:4:'
# shellcheck disable=SC2016
echo 'echo $1' >>run
refuses shell SC2086
# shellcheck disable=SC2016
echo 'step $1' >>steps.sh
refuses shell SC2086
# shellcheck disable=SC2016
printf '%s\n' 'mapfile -t lines </dev/null' 'echo "${lines[@]}"' >>run
refuses shell 'bash 3.2 lacks: run:5:mapfile'
echo '# shellcheck shell=bash' >alone.sh
refuses shell "alone.sh has no #!, and no script reads it"
printf '# %0129d\n' 0 >>run
refuses columns 'run:5: 131 columns; at most 130'
printf '// %0128d\n' 0 >>src/twice.cpp
refuses columns 'src/twice.cpp:4: 131 columns; at most 130'
printf 'C     %067d\n' 0 >>fixed.f
refuses columns 'fixed.f:2: 73 columns; at most 72'
printf '\n%0101d\n' 0 >>page.md
refuses columns 'page.md:13: 101 columns; at most 100'
# shellcheck disable=SC2016
printf '\n```sh\n%0131d\n```\n' 0 >>page.md
refuses columns 'page.md:14: 131 columns; at most 130'
echo 'import os' >>tool.py
refuses python "'os' imported but unused"
echo 'std::vector<int> numbers;' >>src/twice.cpp
refuses includes "'vector' in namespace 'std' does not name a template type"
printf '\nstd::string lost(std::string text) {\n  std::string kept = std::move(text);\n  return kept + text;\n}\n' >>src/twice.cpp
refuses tidy bugprone-use-after-move
printf '\nclass Idle {\n  int unused_ = 0;\n};\n' >>src/twice.cpp
refuses tidy clang-diagnostic-unused-private-field
printf '\nclass Idle {\n  int unused_ = 0;\n};\n' >>bench/steps/steps.cpp
refuses clang clang-diagnostic-unused-private-field
echo 'static int unused(void) { return 1; }' >>tests/cli/test_none.c
refuses clang clang-diagnostic-unused-function
mkdir -p src/riis/api
printf 'using std::string;\nusing std::move;\nvoid keep(string);\n' >src/riis/api/moved.cpp
refuses tidy 'src/riis/api/moved.cpp: the name move of a using-declaration is not used'
rm -rf "$scratch"

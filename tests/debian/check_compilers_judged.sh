#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_compilers_judged.sh SOURCE_FOLDER SCRATCH_FOLDER
# The parts of ./run compilers must notice changed bits, a warning, and wrong words.
set -euo pipefail
sources=$(readlink -f "$1") scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

# ends STATUS TEXT COMMAND...: the command must end with this status, and its output must contain the text.
ends() {
  local status=$1 text=$2 said ended=0
  shift 2
  said=$("$@" 2>&1) || ended=$?
  [[ $ended == "$status" && $said == *"$text"* ]] || { echo "'$*' ended with $ended and said: $said" >&2; exit 1; }
}

ends 2 "./run compilers: 'g++' is neither an option nor compilers with versions, such as g++-12" "$sources/run" compilers g++
ends 2 "'--quick' is neither an option" "$sources/run" compilers --all --quick
ends 1 "none of these compilers is installed: g++-1" "$sources/tests/debian/compilers.sh" "$sources" "$PWD/none" '' g++-1

# For the bits: a program that gives other bits on 3 threads, and refuses AVX-512.
printf ' 0 aortic 0123\nall 4567\n' >expected.txt
cat >program <<'END'
#!/bin/bash
case "$*" in
  3) printf ' 0 aortic 0124\nall 4567\n' ;;
  '1 3') echo "riis_mark_nodes: RIIS_UNAVAILABLE: no AVX-512" >&2 && exit 1 ;;
  '1 2') echo "killed" >&2 && exit 9 ;;
  *) cat expected.txt ;;
esac
END
chmod +x program
same_bits=$sources/tests/process/check_same_bits.sh
ends 0 "8 threads, baseline instructions: the same bits" "$same_bits" ./program expected.txt
ends 1 "3 threads: 1 lines differ" "$same_bits" ./program expected.txt all
ends 1 "4 threads: the same bits" "$same_bits" ./program expected.txt all
ends 1 "AVX-512: not tested: riis_mark_nodes: RIIS_UNAVAILABLE" "$same_bits" ./program expected.txt all
ends 1 "AVX2: killed" "$same_bits" ./program expected.txt all

# For the files: one has a warning, and one is valid only in C++20.
commands() {
  printf '[{"directory": "%s", "file": "%s", "command": "c++ -Wall -Werror -o a.o -c %s"}]' "$PWD" "$1" "$1" \
    >compile_commands.json
}
read_sources=$sources/tests/debian/read_sources.py
echo 'consteval int two() { return 2; }' >twice.cpp
commands twice.cpp
ends 0 "1 files, 1 times read, 0 with faults" "$read_sources" . c++20
ends 1 "1 files, 2 times read, 1 with faults" "$read_sources" . c++17 c++20
echo 'int two(void) { int unused; return 2; }' >unused.c
commands unused.c
ends 1 "-Werror=unused-variable" "$read_sources" . c++17 c++20
echo '[]' >compile_commands.json
ends 1 "has no files" "$read_sources" . c++17
cd /
rm -rf "$scratch"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the fuzzing harnesses.
#   fuzz.sh test BUILD_DIR HARNESS             runs one harness for RIIS_FUZZ_TEST_SECONDS (9) and keeps only findings
#   fuzz.sh all BUILD_DIR SECONDS N_JOBS OUT   runs all harnesses for SECONDS altogether, N_JOBS at a time, and prints a table.
#                                              OUT keeps the harnesses' logs and findings, and their corpora for the next run.
#   fuzz.sh add HARNESS FILE                   adds an input to corpus.txt, with which each run of the harness begins
#   fuzz.sh inputs FOLDER                      writes the inputs of corpus.txt as files FOLDER/HARNESS/NAME
# RIIS_FUZZ_SEED is the seed of the mutations: 1 by default; "random" draws one. The seed is printed. The script fails if there is
# a finding.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "$0")")
mode=$1 build=$2

# write_inputs FOLDER: writes the inputs of corpus.txt as files FOLDER/HARNESS/NAME.
write_inputs() {
  local file
  for file in "${harnesses[@]}"; do mkdir -p "$1/$file"; done
  awk -v folder="$1" '
    /^== / { if (file) close(file); file = folder "/" $2 ($3 == "base64" ? ".base64" : ""); printf "" >file; next }
    file { print >file }' "$here/corpus.txt"
  find "$1" -name '*.base64' | while read -r file; do
    base64 -d <"$file" >"${file%.base64}"
    rm "$file"
  done
}

seed=${RIIS_FUZZ_SEED:-1}
[[ $seed != random ]] || seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')

# Each harness gets its share of the time.
declare -A shares=([api]=8 [grid]=2 [vtk]=4 [vtu]=3 [vtp]=3 [vti]=2 [vtr]=2 [vts]=1 [pvd]=1 [pvtu]=1
  [json]=3 [stl]=2 [obj]=1 [ply]=2 [command_line]=2 [cycle]=1 [msh]=2 [xdmf]=1 [foam]=2)
harnesses=(api grid vtk vtu vtp vti vtr vts pvd pvtu json stl obj ply command_line cycle msh xdmf foam)

# options HARNESS SECONDS: prints the options for every run of a harness. The options limit the seconds for a single input. The
# options also limit the memory, most of which the address sanitizer needs. An input of the allowed size should not reach the
# limits of time and memory.
options() {
  local max_len=4096 dictionary=$1
  case $1 in
    api)
      max_len=1024
      echo -len_control=10 # tries long sequences early
      ;;
    command_line)
      max_len=1024
      echo -close_fd_mask=1 # hides the help that the harness prints
      ;;
    vtu | vtp | vti | vtr | vts | pvd | pvtu | xdmf) dictionary=xml ;;
  esac
  # VTK's readers leak memory on inputs that they refuse. Checking for leaks after each such input would take all of the time, so
  # leaks are checked only at the end.
  [[ $1 != vt? && $1 != pvd && $1 != pvtu && $1 != stl ]] || echo -detect_leaks=0
  printf '%s\n' -max_total_time="$2" -max_len=$max_len -timeout=300 -rss_limit_mb=4000 -malloc_limit_mb=4000 -print_final_stats=1
  [[ ! -f $here/$dictionary.dict ]] || echo -dict="$here/$dictionary.dict"
}

# fuzz HARNESS SECONDS FINDINGS CORPUS...: runs a harness and adds new inputs to the first corpus. The run is split into several
# processes with different seeds, because VTK's leaks add up.
fuzz() {
  local name=$1 left=$2 findings=$3 arguments now number=0
  shift 3
  mkdir -p "$findings"
  while ((left > 0)); do
    now=$((left < 300 ? left : 300))
    mapfile -t arguments < <(options "$name" "$now")
    "$build/tests/fuzz/fuzz_$name" "${arguments[@]}" -seed=$((seed + number)) -artifact_prefix="$findings/" "$@" || return
    left=$((left - now))
    number=$((number + 1))
  done
  echo "all of $name done"
}

# Prints the numbers that follow "$1: " in the log $2.
numbers() {
  grep -oE "(^|[ :])$1: +[0-9]+" "$2" | grep -oE '[0-9]+$' || true
}

run_test() {
  local name=$1
  learnt=$(mktemp -d)
  trap 'rm -rf "$learnt"' EXIT
  echo "seed $seed"
  write_inputs "$learnt/inputs"
  mkdir "$learnt/new"
  fuzz "$name" "${RIIS_FUZZ_TEST_SECONDS:-9}" "$build/findings/$name" "$learnt/new" "$learnt/inputs/$name"
}

run_all() {
  local seconds=$1 n_jobs=$2 out=$3 name parts=0 mine status=0 n_findings executions
  local -A given=()
  for name in "${harnesses[@]}"; do parts=$((parts + shares[$name])); done
  ((n_jobs <= ${#harnesses[@]})) || n_jobs=${#harnesses[@]}
  echo "seed $seed; logs, corpora and findings in $out"
  rm -rf "$out/inputs"
  write_inputs "$out/inputs"
  for name in "${harnesses[@]}"; do
    while (($(jobs -rp | wc -l) >= n_jobs)); do wait -n || true; done
    mine=$((seconds * n_jobs * shares[$name] / parts))
    # A harness gets at most the whole time.
    ((mine <= seconds)) || mine=$seconds
    ((mine >= 1)) || mine=1
    given[$name]=$mine
    mkdir -p "$out/$name/corpus" "$out/$name/findings"
    # The run begins with the earlier findings. The run reports a finding again if the fault still exists.
    find "$out/$name/findings" -type f -exec mv -t "$out/$name/corpus" {} +
    echo "$name: $mine s"
    fuzz "$name" "$mine" "$out/$name/findings" "$out/$name/corpus" "$out/inputs/$name" >"$out/$name/log" 2>&1 </dev/null &
  done
  wait || true
  printf '%-13s %11s %6s %6s %6s %7s %9s\n' harness executions per_s cov ft corpus findings
  for name in "${harnesses[@]}"; do
    n_findings=$(find "$out/$name/findings" -type f | wc -l)
    executions=$(numbers stat::number_of_executed_units "$out/$name/log" | awk '{ n += $1 } END { print n + 0 }')
    printf '%-13s %11s %6s %6s %6s %7s %9s\n' "$name" "$executions" $((executions / given[$name])) \
      "$(numbers cov "$out/$name/log" | tail -n 1)" "$(numbers ft "$out/$name/log" | tail -n 1)" \
      "$(find "$out/$name/corpus" -type f | wc -l)" "$n_findings"
    # A harness may end early because it did not start, or because it found a fault such as a leak at the end.
    if ((n_findings > 0)) || ! grep -q "^all of $name done" "$out/$name/log"; then
      status=1
      echo "  $out/$name/log:"
      grep -E 'ERROR|SUMMARY|expected|runtime error' "$out/$name/log" | head -n 5 || true
    fi
  done
  return "$status"
}

case $mode in
  test) run_test "$3" ;;
  all) run_all "$3" "$4" "$5" ;;
  add) { echo "== $2/$(basename "$3") base64" && base64 -w 100 "$3"; } >>"$here/corpus.txt" ;;
  inputs) write_inputs "$2" ;;
  *)
    echo "fuzz.sh: no mode '$mode'" >&2
    exit 2
    ;;
esac

# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# ./run uris: exports each kind of valve for svMultiPhysics with triangles of several sizes and reads the files back. It prints
# the error of marks by the middles of triangles. The script `run` reads this file, which uses $build, $n_jobs, install_missing,
# step and say of `run`.

# Largest edges, cm. The half thickness is 0.1. "none" means the triangles that the library makes.
uris_edges=(none 0.1 0.05 0.035 0.025 0.02 0.015)

# export_of_size KIND EDGE: writes build/uris/KIND_EDGE, and prints the solver's input to build/uris/KIND_EDGE.xml.
export_of_size() {
  local folder=$build/uris/$1_$2 size=()
  [[ $2 == none ]] || size=(--largest-edge "$2")
  "$build/bin/riis" export "$folder" --valve "$1" --resistance 1e4 --time-step 0.005 \
    --opening-seconds 0.01 --closing-seconds 0.01 "${size[@]}" >"$folder.xml"
}

uris() {
  local kind edge blocks
  (($# == 0)) || { echo "./run uris: '$*' is not an argument of this command" >&2; exit 2; }
  install_missing
  step "configure" cmake --preset default
  step "build the program, its tests and the reader" cmake --build --preset default --parallel "$n_jobs" \
    --target riis_program test_cli_uris test_cli_uris_refusals riis_bench_uris
  rm -rf "$build/uris"
  mkdir -p "$build/uris"
  for kind in aortic trileaflet mitral bileaflet; do
    for edge in "${uris_edges[@]}"; do
      step "export the $kind valve, largest edge $edge" export_of_size "$kind" "$edge"
    done
  done
  say "read the files back as the solver does, and compare with the library's vertices"
  ctest --preset default --tests-regex '^test_cli_uris'
  printf '\n|'
  printf ' %s |' valve 'largest edge, cm' triangles 'longest edge' marked lost 'sum of delta too small by' \
    'largest excess' 'outside the box'
  printf '\n|---|---|---|---|---|---|---|---|---|\n'
  for kind in aortic trileaflet mitral bileaflet; do
    blocks=()
    for edge in "${uris_edges[@]}"; do blocks+=("$build/uris/${kind}_$edge.xml"); done
    "$build/bench/riis_bench_uris" "$kind" 200 "${blocks[@]}"
  done
}

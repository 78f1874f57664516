# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# `run` reads this file for ./run uris. The steps use $build, $n_jobs, install_missing, step and say of `run`.

# The largest edges of exported triangles in cm, for the half thickness 0.1 cm. "none" stands for the library's triangles.
uris_edges=(none 0.1 0.05 0.035 0.025 0.02 0.015)

# export_of_size KIND EDGE: writes build/uris/KIND_EDGE, and prints the solver's input to build/uris/KIND_EDGE.xml.
export_of_size() {
  local folder=$build/uris/$1_$2 size=()
  [[ $2 == none ]] || size=(--largest-edge "$2")
  "$build/bin/riis" export "$folder" --valve "$1" --resistance 1e4 --time-step 0.005 \
    --opening-seconds 0.01 --closing-seconds 0.01 "${size[@]}" >"$folder.xml"
}

# ---- ./run uris drop ----

# Writes a duct of 2 cm x 2 cm, from z = -1.3 to 1.3, with edges of about $2 cm, as $3.msh. The duct `tube` has tetrahedra, and
# fits the trileaflet valve.
duct_of_edge() { # arguments: hex|tet|tube, edge, path without ending
  if [[ $1 == hex ]]; then
    cat >"$3.geo" <<'END'
Point(1) = {-1, -1, -1.3};
Extrude {2, 0, 0} { Point{1}; Layers{Round(2 / h)}; Recombine; }
Extrude {0, 2, 0} { Curve{1}; Layers{Round(2 / h)}; Recombine; }
Extrude {0, 0, 2.6} { Surface{5}; Layers{Round(2.6 / h)}; Recombine; }
END
  else
    local -A shapes=([tet]="Box(1) = {-1, -1, -1.3, 2, 2, 2.6};" [tube]="Cylinder(1) = {0, 0, -1.6, 0, 0, 3.6, 1.25};")
    cat >"$3.geo" <<END
SetFactory("OpenCASCADE");
${shapes[$1]}
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
END
  fi
  cat >>"$3.geo" <<'END'
Physical Volume(1) = {1};
END
  gmsh -3 -format msh2 -setnumber h "$2" -o "$3.msh" "$3.geo" >"$3.log" || { cat "$3.log" >&2; return 1; }
}

# export_in_duct PATH HALF_THICKNESS SHIFT [TIME_STEP VALVE EDGE]: exports a valve with triangles up to EDGE to PATH and PATH.xml.
# The valve is moved along the duct of PATH.msh. The default valve is flat.
export_in_duct() {
  local time_step=${4-0.002}
  rm -rf "$1"
  RIIS_PYTHON=${RIIS_PYTHON-$(python_of_packages)} \
    "$build/bin/riis" export "$1" "$1.msh" --valve "${5-$build/uris/flat.json}" --resistance 1e4 --time-step "$time_step" \
    --opening-seconds "$time_step" --closing-seconds "$time_step" --half-thickness "$2" --largest-edge "${6-0.03}" \
    --translate "0,0,$3" >"$1.xml" 2>/dev/null
}

# expected_drop PATH: prints the drop over (R/eps) u that the export forecasts.
expected_drop() { sed -n 's/.*closed valve: \([0-9.]*\) of.*/\1/p' "$1.xml"; }

# leaflets_area PATH: prints the area of the closed leaflets in the mesh in cm2, as the export found it.
leaflets_area() { sed -n 's/.*leaflets in the mesh, \([0-9.e+-]*\);.*/\1/p' "$1.xml"; }

# Moves a flat valve along the duct. Prints the expected drop, and the share of the sum of delta.
drop_in_duct() { # arguments: path without ending, half thickness, shift along the duct
  export_in_duct "$1" "$2" "$3" &&
    printf '%s %s' "$(expected_drop "$1")" "$(sed -n 's/.*sum of delta is \([0-9.e+-]*\) of.*/\1/p' "$1.xml")"
}

# Writes a flat valve for the duct. With $2, the valve rises by $2 over half of the duct. Without $2, the valve lies straight
# across the duct.
flat_valve() { # arguments: name of the file, rise
  local low=-${2-0} high=${2-0}
  cat >"$build/uris/$1.json" <<END
{"curves": {"a": [[-1, -1, $low], [1, -1, $low]], "b": [[-1, 1, $high], [1, 1, $high]],
            "c": [[-1, -1, $low], [-1, 1, $high]], "d": [[1, -1, $low], [1, 1, $high]]},
 "patches": [{"v0": "a", "v1": "b", "u0": "c", "u1": "d"}],
 "open": {"curves": {"a": [[-1, -1, $low], [1, -1, $low]], "b": [[-1, -0.9, 0.9], [1, -0.9, 0.9]],
                     "c": [[-1, -1, $low], [-1, -0.9, 0.9]], "d": [[1, -1, $low], [1, -0.9, 0.9]]}}}
END
}

# For a flat valve in a duct, prints the drop that the solver will have, and its sum of delta.
uris_drop() {
  local elements ratio edge shift path
  flat_valve flat
  printf '\n| elements | eps / h | drop over (R/eps) u | sum of delta over the exact sum |\n|---|---|---|---|\n'
  for elements in hex tet; do
    for ratio in 1 1.2 1.5 2; do
      edge=$(awk "BEGIN { print 0.2 / $ratio }")
      path=$build/uris/duct_${elements}_$ratio
      duct_of_edge $elements "$edge" "$path"
      for shift in 0 0.25 0.5; do
        drop_in_duct "$path" 0.2 "$(awk "BEGIN { print $edge * $shift }")"
        echo
      done | awk -v name=$elements -v ratio=$ratio '
        NF == 2 { d[++n] = $1; s[n] = $2 }
        END {
          if (n != 3) exit 1
          low_d = d[1]; high_d = d[1]; low_s = s[1]; high_s = s[1]
          for (i = 2; i <= n; ++i) {
            if (d[i] < low_d) low_d = d[i]; if (d[i] > high_d) high_d = d[i]
            if (s[i] < low_s) low_s = s[i]; if (s[i] > high_s) high_s = s[i]
          }
          printf "| %s | %s | %.2f to %.2f | %.2f to %.2f |\n", name, ratio, low_d, high_d, low_s, high_s
        }'
    done
  done
}

# ---- ./run uris solver PROGRAM ----

# Each line has these numbers: the valve, the elements of its duct, eps over their edge, the shift of the valve over the edge, the
# time step in s, eps in cm, and the largest edge of the valve's triangles in cm. In each marking the solver measures the distance
# of each node to each triangle.
uris_solver_cases=(
  "flat hex 1.1 0.3 0.001 0.2 0.03" "flat hex 1.1 0.3 0.004 0.2 0.03" "flat hex 1.5 0.3 0.001 0.2 0.03"
  "flat hex 1.5 0.3 0.004 0.2 0.03" "flat hex 2 0.3 0.001 0.2 0.06" "flat hex 3 0.3 0.001 0.4 0.06"
  "leaning hex 1.5 0 0.001 0.2 0.03" "flat tet 1.1 0.3 0.001 0.2 0.03" "flat tet 1.1 0.3 0.004 0.2 0.03"
  "flat tet 1.5 0.3 0.001 0.2 0.03" "flat tet 1.5 0.3 0.004 0.2 0.03" "flat tet 2 0.3 0.001 0.2 0.03"
  "flat tet 2 0.3 0.004 0.2 0.06" "flat tet 3 0.3 0.004 0.4 0.06" "leaning tet 1.5 0 0.004 0.2 0.06"
  "trileaflet tube 1.2 0 0.001 0.2 0.06"
)

# uris_solver PROGRAM: runs svMultiPhysics with closed valves, and prints its drop beside the forecast.
uris_solver() {
  local program python row valve file elements ratio shift time_step eps size edge path case expected measured
  program=$(realpath -- "$1") python=$(python_of_packages)
  flat_valve flat
  flat_valve leaning 0.36397 # by 20 degrees
  printf '\n|'
  printf ' %s |' valve elements eps 'eps / h' 'shift / h' 'time step' 'triangles / eps' forecast 'in the solver' 'too large by'
  printf '\n|---|---|---|---|---|---|---|---|---|---|\n'
  for row in "${uris_solver_cases[@]}"; do
    read -r valve elements ratio shift time_step eps size <<<"$row"
    edge=$(awk "BEGIN { print $eps / $ratio }")
    path=$build/uris/duct_${elements}_${ratio}_$eps
    case=$build/uris/case_${row// /_}
    file=$build/uris/$valve.json
    [[ -e $file ]] || file=$valve
    duct_of_edge "$elements" "$edge" "$path" || return
    export_in_duct "$path" "$eps" "$(awk "BEGIN { print $edge * $shift }")" "$time_step" "$file" "$size" || return
    rm -rf "$case"
    "$python" -B bench/peers/uris_case.py write "$path.msh" "$path.xml" "$case" "$time_step" || return
    (cd "$case" && "$program" solver.xml >log.txt 2>&1) || { tail -n 5 "$case/log.txt" >&2; return 1; }
    expected=$(expected_drop "$path")
    measured=$("$python" -B bench/peers/uris_case.py drop "$case" "$(leaflets_area "$path")" "$expected") || return
    printf '| %s | %s | %s cm | %s | %s | %s ms | %s | %s | %s | %s %% |\n' "$valve" "$elements" "$eps" "$ratio" "$shift" \
      "$(awk "BEGIN { print 1000 * $time_step }")" "$(awk "BEGIN { print $size / $eps }")" "$expected" "$measured" \
      "$(awk "BEGIN { printf \"%.2f\", 100 * ($expected / $measured - 1) }")"
  done
}

# ./run uris [drop | solver PROGRAM]
#   Exports every kind of valve for svMultiPhysics with triangles of several sizes, and reads the files. Prints the errors of
#   this solver's marks, for the table of docs/export.md. drop instead prints the drop that the solver will have across a flat
#   valve, in meshes by gmsh. solver runs PROGRAM, an svmultiphysics, with closed valves, and prints its drop beside the forecast.
run_uris() {
  local kind edge blocks
  if [[ (${1-} == drop && $# == 1) || (${1-} == solver && $# == 2) ]]; then
    [[ $1 == drop || -x $2 ]] || { echo "./run uris solver: '$2' is not a program" >&2; exit 2; }
    install_missing
    step "configure" cmake --preset default
    step "build the program" cmake --build --preset default --parallel "$n_jobs" --target riis_program
    mkdir -p "$build/uris"
    "uris_$1" "${@:2}"
    return
  fi
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

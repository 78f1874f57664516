# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run flow: compile, check, run, draw, print the results. `run` sources this file. The steps use $n_jobs, $logs,
# install_missing, is_on_offer, python_of_packages, say and step of `run`.

# Packages of Debian 12 or 13 that ./run flow needs, without recommends.
flow_packages=(gcc g++ gfortran cmake make libembree-dev libtbb-dev libopenmpi-dev libhypre-dev python3-matplotlib ffmpeg)
flow_build="build-flow"

# flow_compile: installs the library and its Fortran modules into a folder, and compiles the solver as a separate project.
flow_compile() {
  cmake --preset library -B "$flow_build/library" -D RIIS_WITH_FORTRAN=ON -D CMAKE_INSTALL_PREFIX="$PWD/$flow_build/riis" &&
    cmake --build "$flow_build/library" --parallel "$n_jobs" &&
    cmake --install "$flow_build/library"
}

flow_compile_solver() {
  cmake -S examples/flow_fortran -B "$flow_build/solver" -D CMAKE_PREFIX_PATH="$PWD/$flow_build/riis" &&
    cmake --build "$flow_build/solver" --parallel "$n_jobs"
}

# flow_restart FOLDER FIRST SECOND WORD...: restarts a run from its step FIRST, and continues to the step SECOND. The state at
# SECOND and the rows of the table in between must equal those of the first run.
flow_restart() {
  local folder=$1 first=$2 second=$3 again=$1/again
  shift 3
  rm -rf "$again"
  mkdir -p "$again/frames"
  "$flow_build/solver/flow" "$@" save="$second" steps="$second" out="'$again'" restart="'$folder/restart_$first.bin'" &&
    cmp "$folder/restart_$second.bin" "$again/restart_$second.bin" &&
    cmp <(awk -F , -v a="$first" -v b="$second" '$1 + 0 > a && $1 + 0 <= b' "$folder/beat.csv") <(sed 1d "$again/beat.csv") &&
    rm -rf "$again"
}

# flow_story FOLDER: describes the heartbeat, from its table.
flow_story() {
  LC_ALL=C awk -F , '
    NR == 1 { next }
    { dt = $3; flow = $8; if (flow > 0) forward += dt * flow; else if ($4 > 0) closing -= dt * flow; else leak -= dt * flow }
    flow > peak { peak = flow; when = $2 }
    $9 > jet { jet = $9 }
    $6 - $7 > most { most = $6 - $7 }
    $7 - $6 > held { held = $7 - $6; force = $12 }
    $7 > top { top = $7 }
    END {
      printf "\n  forward flow              %6.1f ml, at most %.0f ml/s at %.0f ms\n", 1e6 * forward, 1e6 * peak, 1e3 * when
      printf "  back while it closes      %6.1f ml\n  through the closed valve  %6.1f ml\n", 1e6 * closing, 1e6 * leak
      printf "  jet                       %6.2f m/s\n", jet
      printf "  pressure in the aorta     %6.0f mmHg at most\n", top / 133.322
      printf "  the closed valve holds    %6.0f mmHg, and a force of %.1f N\n", held / 133.322, force
    }' "$1/beat.csv"
}

# ./run flow [--cells N | --short] [--offset O]
#   Builds a flow solver in Fortran with a beating aortic valve in its root, and checks the solver against exact formulas. The
#   command computes one heartbeat with some 77,000 cells. In out/flow it leaves plots of pressures, flow, opening, jet and force,
#   and a movie of the velocity. --cells takes N cells across the root instead of 40, which changes the half thickness. --short
#   computes on a coarse grid until the valve opens, in out/flow_short. With --offset the band is shifted by O half thicknesses.
#   The band then has a cut rim and a skirt, and the folder's name ends in _offset. The command is skipped if the distribution
#   lacks libhypre-dev.
# ./run flow --study
#   Prints the effects of resistance, half thickness and size of cells on the drop and the leak.
# ./run flow --drops [--short]
#   Computes the steady drops of the aortic, coapting and trileaflet valves at some openings, flows, half thicknesses and offsets,
#   in ten minutes of processor time. The command leaves a plot and a table, which compares the drops with two formulas, in
#   out/drops. Finished runs in that folder are kept, so a second call continues after a stop. --short makes six runs on a coarse
#   grid, in out/drops_short.
run_flow() {
  local out=out/flow python words=() save=(600 620) short=() offset='' what=beat
  while (($# > 0)); do
    case $1 in
      --short) short=(--short) ;;
      --study) what=study ;;
      --drops) what=drops ;;
      --cells)
        [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || { echo "./run flow: --cells needs a number, not '${2:-}'" >&2; exit 2; }
        words+=(cells="$2")
        shift
        ;;
      --offset)
        [[ ${2:-} =~ ^-?0?(\.[0-9]+)?$ && ${2:-} =~ [0-9] ]] ||
          { echo "./run flow: --offset needs a number above -1 and below 1, not '${2:-}'" >&2; exit 2; }
        offset=_offset
        words+=(offset="$2" cut_rim=T skirt=2e-3)
        shift
        ;;
      *)
        echo "./run flow: '$1' is not an option" >&2
        exit 2
        ;;
    esac
    shift
  done
  if [[ $what != beat && ${words[*]} ]]; then
    echo "./run flow: --$what goes with neither --cells nor --offset" >&2
    exit 2
  fi
  if [[ ${short[*]} ]]; then out=out/flow_short words=(cells=24 end_time=0.16 frames=12 "${words[@]}") save=(60 80); fi
  out+=$offset
  if command -v dpkg-query >/dev/null && ! is_on_offer libhypre-dev; then
    say "flow is skipped: this distribution lacks the package libhypre-dev"
    return
  fi
  packages=("${flow_packages[@]}")
  install_missing
  export OMP_WAIT_POLICY=passive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  step "compile the library" flow_compile
  step "compile the flow solver" flow_compile_solver
  if [[ $what == study ]]; then
    "$flow_build/solver/flow_checks" study
    return
  fi
  python=$(python_of_packages)
  if [[ $what == drops ]]; then
    out=out/drops${short:+_short}
    say "steady drops; finished runs are kept in $out/runs.csv"
    "$python" -B examples/flow_fortran/drops.py "$flow_build/solver/drop" "$out" "${short[@]}"
    return
  fi
  say "check the solver against closed forms"
  "$flow_build/solver/flow_checks"
  say "a cusp of springs, a toy"
  "$flow_build/solver/membrane"
  say "one heartbeat"
  rm -rf "$out"
  mkdir -p "$out/frames"
  "$flow_build/solver/flow" "${words[@]}" save="${save[0]},${save[1]}" out="'$out'"
  step "go on from step ${save[0]} in a second run: the same bits" flow_restart "$out" "${save[@]}" "${words[@]}"
  step "draw" "$python" -B examples/flow_fortran/plots.py "$out"
  flow_story "$out"
  say "wrote $out/beat.png, $out/flow.mp4 and stills of it, $out/beat.csv, $out/frames"
  [[ ! ${short[*]} ]] || say "this was the short variant: a coarse grid, and the beat until the valve opens"
}

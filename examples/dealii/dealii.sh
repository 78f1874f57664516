# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run dealii: install deal.II, compile, run, check, draw. `run` sources this file. The steps use $build, $n_jobs,
# $packages, install_missing, is_on_offer, python_of_packages, say and step of `run`.

# Debian 13's deal.II passes -fuse-ld=mold to programs that link it, but the Debian package does not depend on mold.
dealii_packages=(gcc g++ cmake ninja-build mold libembree-dev libtbb-dev libdeal.ii-dev openmpi-bin libopenblas0-pthread
  python3-numpy python3-matplotlib)
dealii_here=$PWD/examples/dealii

# ./run dealii [--short]
#   Runs valves in deal.II, a finite element library, on meshes that follow the leaflets. The valves are a closed plate with an
#   exact drop, a moving plate, and a beating trileaflet valve. The command compares 1, 2 and 4 ranks, checks a restart and bad
#   input, and leaves tables and pictures in out/dealii. --short leaves out 4 ranks, most plates and the beat. The command is
#   skipped if the distribution lacks libdeal.ii-dev.
run_dealii() {
  local short='' python out=$PWD/out/dealii ranks=(1 2 4)
  case $* in
    '') ;;
    --short) short=yes ranks=(1 2) ;;
    *)
      echo "./run dealii: '$*' is not an option" >&2
      exit 2
      ;;
  esac
  is_on_offer libdeal.ii-dev || {
    say "skipped: this distribution has no package libdeal.ii-dev; Debian 12 and 13 have it"
    return 0
  }
  packages=("${dealii_packages[@]}")
  install_missing
  python=$(python_of_packages)
  di_work=$PWD/$build/dealii
  di_runs=$di_work/runs
  di_program=$di_work/example/valve_flow
  rm -rf "$di_runs" "$out"
  mkdir -p "$di_runs" "$out"
  step "build the library and the example" dealii_build
  export OPENBLAS_NUM_THREADS=1
  set_ranks
  di_check() { "$python" -B "$dealii_here/check.py" "$@"; }

  step "bad input, which must be refused" di_check refusals "$di_program" "$di_runs/refusals" "$dealii_here"/{beat,closed}.prm
  cp "$logs/bad-input--which-must-be-refused.log" "$out/refusals.txt"
  dealii_plates "$short"
  step "a closed plate in a steady flow" dealii_closed
  di_check drops "${di_drops[@]}" | tee "$out/drops.txt"
  step "a plate that moves between equal pressures" dealii_run plate 1 closed \
    Inlet/Type=pressure Valve/Speed=0.1 Valve/Position=0.0152
  di_check plate "$di_runs/plate" 0.1 | tee "$out/plate.txt"
  step "the trileaflet valve opens, on ${ranks[*]} ranks" dealii_ranks "${ranks[@]}"
  di_check same "${ranks[@]/#/$di_runs/ranks-}" | tee "$out/ranks.txt"
  di_check refined "$di_runs/ranks-1" 2.2e-3 | tee -a "$out/ranks.txt"
  step "a restart while the valve moves" dealii_restart
  di_check same "$di_runs"/{ranks-2,restart-2,restart-1} | tee "$out/restart.txt"
  di_check another "$di_program" "$dealii_here/beat.prm" "$di_runs/refusals" "$di_runs/ranks-2" | tee -a "$out/refusals.txt"
  if [[ ! $short ]]; then
    step "the trileaflet valve beats (the longest step)" dealii_run beat 2 beat Run/Pictures\ every=4
    di_check beat "$di_runs/beat" 2.2e-3 1e3 | tee "$out/beat.txt"
    di_check plot "$di_runs/beat" "$out/beat.png"
    cp "$di_runs"/beat/flow_*vtu "$di_runs/beat/steps.csv" "$out"
  fi
  di_check picture "$di_runs/ranks-1" "$out/velocity.png"
  say "wrote out/dealii/velocity.png and the tables out/dealii/*.txt"
}

dealii_build() {
  install_library "$di_work" &&
    cmake -S "$dealii_here" -B "$di_work/example" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH="$di_work/riis" &&
    cmake --build "$di_work/example"
}

# dealii_run NAME RANKS CASE [SUBSECTION/ENTRY=VALUE...]: runs CASE.prm with these entries, in the folder NAME.
dealii_run() {
  local folder=$di_runs/$1 n_ranks=$2 file=$dealii_here/$3.prm entry
  shift 3
  mkdir -p "$folder"
  for entry; do
    printf 'subsection %s\n  set %s\nend\n' "${entry%%/*}" "${entry#*/}"
  done >"$folder/more.prm"
  (cd "$folder" && timeout 1800 mpirun -n "$n_ranks" "$di_program" "$file" more.prm)
}

# dealii_plates SHORT: sets di_drops to the runs of closed plates, in meshes with edges of 2 mm: FOLDER:ELEMENTS:HALF
# THICKNESS:R:SPEED:TIME STEP.
dealii_plates() {
  local eps dt elements thicknesses=(1.7e-3 2.2e-3 3e-3 5e-3)
  [[ ! $1 ]] || thicknesses=(2.2e-3)
  di_drops=()
  for elements in hexahedra 'distorted hexahedra' 'refined at the plate'; do
    for eps in "${thicknesses[@]}"; do
      [[ $elements != refined* || $eps == 2.2e-3 ]] || continue
      for dt in 1e-3 4e-3; do
        di_drops+=("$di_runs/plate-${elements%% *}-$eps-$dt:$elements:$eps:1e4:0.01:$dt")
      done
    done
  done
}

dealii_closed() {
  local run folder elements eps dt distortion refinements
  for run in "${di_drops[@]}"; do
    IFS=: read -r folder elements eps _ _ dt <<<"$run"
    distortion=0 refinements=0
    [[ $elements != distorted* ]] || distortion=0.2
    [[ $elements != refined* ]] || refinements=1
    dealii_run "${folder##*/}" 1 closed "Duct/Distortion=$distortion" "Duct/Refinements at the valve=$refinements" \
      "Valve/Half thickness=$eps" "Run/Time step=$dt" || return
  done
}

# dealii_ranks: runs the same steps on several numbers of ranks. Each run saves its state in the middle.
dealii_ranks() {
  local ranks
  for ranks; do
    dealii_run "ranks-$ranks" "$ranks" beat Run/Steps=3 Run/Save\ after=2 || return
  done
}

dealii_restart() {
  local ranks
  for ranks in 2 1; do
    dealii_run "restart-$ranks" "$ranks" beat Run/Steps=3 "Run/Restart from=$di_runs/ranks-2" || return
  done
}

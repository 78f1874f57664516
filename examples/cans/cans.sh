# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run cans: copy the sources, insert the valve, compile, run, check, draw. `run` sources this file. The steps use
# $build, $packages, install_library, install_missing, python_of_packages, say, set_ranks and step of `run`.

# `run` has already refused this command if bash lacks associative arrays.
((BASH_VERSINFO[0] >= 4)) || return 0

cans_packages=(gcc g++ gfortran cmake make ninja-build pkg-config libembree-dev libtbb-dev libfftw3-dev openmpi-bin
  libopenmpi-dev python3-numpy python3-matplotlib)
cans_here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)

# ./run cans FOLDER [--short]
#   Runs valves in CaNS, a structured code with Fourier transforms: a closed plate, upright and leaning, and a trileaflet valve
#   that opens in 40 ms. The plate is run with each way to make the pressure follow K. FOLDER contains CaNS and 2decomp-fft
#   (examples/cans/README.md), and is not changed. The command leaves tables and a picture in out/cans. --short runs only the
#   recommended way. If CaNS is missing, the status is 77.
run_cans() {
  local short='' python out=$PWD/out/cans
  case ${2:-} in
    '') ;;
    --short) short=yes ;;
    *)
      echo "./run cans: '$2' is not an option" >&2
      exit 2
      ;;
  esac
  cans_check_sources "${1:-}" || exit
  packages=("${cans_packages[@]}")
  install_missing
  python=$(python_of_packages)
  cans_work=$PWD/$build/cans
  cans_runs=$cans_work/runs
  rm -rf "$cans_runs" "$out"
  mkdir -p "$cans_runs" "$out"
  set_ranks
  step "copy the sources, and insert the valve" cans_copy "$1"
  step "build the library with its Fortran modules" install_library "$cans_work" -D RIIS_WITH_FORTRAN=ON
  step "compile CaNS" cans_compile
  step "the closed plate for 300 steps, and on 1, 2 and 4 ranks" cans_stable
  if [[ ! $short ]]; then
    step "the lag of the pressure, with each way" cans_lags
    step "a trileaflet valve that opens in 40 ms (the longest step)" cans_opening
  fi
  "$python" -B "$cans_here/check.py" "$cans_runs" ${short:+--short} | tee "$out/checks.md"
  [[ $short ]] || "$python" -B "$cans_here/draw.py" "$cans_runs" "$out/cans.png"
  say "wrote the tables of out/cans"
}

# cans_check_sources FOLDER: the status is 77 if FOLDER lacks the sources. Later, patch.py refuses another version.
cans_check_sources() {
  if [[ ! -f $1/CaNS/src/main.f90 || ! -d $1/2decomp-fft/src ]]; then
    echo "./run cans FOLDER: skipped, FOLDER must hold CaNS 245a233 as CaNS and its fork of 2decomp-fft as 2decomp-fft" \
      "(examples/cans/README.md, \"What to put into the folder\")" >&2
    return 77
  fi
}

# cans_copy FOLDER: copies the sources, so that FOLDER is not changed, and inserts the valve. An existing copy is kept with its
# compiled files, and gets the present user files.
cans_copy() {
  if [[ ! -d $cans_work/CaNS ]]; then
    rm -rf "$cans_work/copy"
    mkdir -p "$cans_work/copy" &&
      cp -R "$1/CaNS" "$cans_work/copy" &&
      rm -rf "$cans_work/copy/CaNS/dependencies/2decomp-fft" &&
      cp -R "$1/2decomp-fft" "$cans_work/copy/CaNS/dependencies" &&
      "$(python_of_packages)" -B "$cans_here/patch.py" "$cans_work/copy/CaNS" &&
      mv "$cans_work/copy/CaNS" "$cans_work/CaNS" &&
      rmdir "$cans_work/copy" || return
  fi
  cp "$cans_here"/riis_{valve,pressure}.f90 "$cans_work/CaNS/src"
}

# Compiles CaNS with the flags of the installed library. The dependencies of CaNS's makefile are made again, because a file was
# added.
cans_compile() {
  local config includes libraries
  config=$(find "$cans_work/riis" -name riis-fortran.pc -printf '%h') || return
  includes=$(PKG_CONFIG_PATH=$config pkg-config --cflags riis-fortran) &&
    libraries=$(PKG_CONFIG_PATH=$config pkg-config --libs riis-fortran) || return
  rm -f "$cans_work/CaNS/build/.depend.mk"
  make -C "$cans_work/CaNS" libs &&
    make -C "$cans_work/CaNS" INCS="$includes" LIBS="$libraries -Wl,-rpath,${config%/pkgconfig}"
}

# cans_run NAME RANKS CASE STEPS VALVE PRESSURE: runs CaNS in the folder NAME with the input CASE.nml. VALVE and PRESSURE are
# lines of riis.nml.
cans_run() {
  local folder=$cans_runs/$1
  mkdir -p "$folder/data"
  sed "s/@STEPS@/$4/" "$cans_here/$3.nml" >"$folder/input.nml"
  printf '&valve\n  %s\n/\n&pressure\n  %s\n/\n' "$5" "$6" >"$folder/riis.nml"
  (cd "$folder" && timeout 1800 mpirun -n "$2" "$cans_work/CaNS/run/cans" >log 2>&1) || {
    tail -n 5 "$folder/log"
    return 1
  }
}

# cans_plate NAME RANKS ANGLE R STEPS PRESSURE: a plate across a duct of 2 x 1 x 1 with 64 x 32 x 32 cells, in a flow of speed 1.
# The half thickness is 1.5 cells. K dt/rho is 214 at the peak for R = 470.
cans_plate() {
  cans_run "$1" "$2" plate "$5" "kind = 'plate', R = $4, half_thickness = 0.046875, place = 1.003, 0.5, 0.5, angle = $3,
  planes = 0.1, 1.9" "$6"
}

cans_stable() {
  local ranks
  cans_plate upright-300 1 90 470 300 'jump = T' && cans_plate leaning-300 1 110 470 300 'jump = T' || return
  for ranks in 1 2 4; do
    cans_plate "ranks-$ranks" "$ranks" 110 470 10 'jump = T, cg = 2' || return
  done
}

# The names of the ways to make the pressure follow K. If a way does not reach the drop within the steps, or diverges, the report
# says so.
declare -A cans_ways=(
  [sweeps-1]='jump = F' [sweeps-2]='jump = F, sweeps = 2' [sweeps-4]='jump = F, sweeps = 4' [sweeps-8]='jump = F, sweeps = 8'
  [extrapolation-0.8]='jump = F, extrapolation = 0.8'
  [jump]='jump = T' [jump-sweeps-2]='jump = T, sweeps = 2' [jump-cg-1]='jump = T, cg = 1' [jump-cg-2]='jump = T, cg = 2'
  [cg-2]='jump = F, cg = 2' [cg-4]='jump = F, cg = 4' [cg-8]='jump = F, cg = 8' [cg-16]='jump = F, cg = 16')

# cans_lags: runs each way at K dt/rho = 214 and 2,000, with an upright and with a leaning plate. CaNS may end with an error if a
# way blows up.
cans_lags() {
  local way R steps
  for way in "${!cans_ways[@]}"; do
    for R in 470 4394.53; do
      steps=40
      [[ $way != sweeps-1 && $way != sweeps-2 || $R != 470 ]] || steps=80
      [[ $way != sweeps-1 || $R == 470 ]] || steps=420
      [[ $way != extra* ]] || steps=100
      cans_plate "upright-$R-$way" 1 90 "$R" "$steps" "${cans_ways[$way]}" || [[ $way == extra* ]] || return
      cans_plate "leaning-$R-$way" 1 110 "$R" "$steps" "${cans_ways[$way]}" || [[ $way == extra* ]] || return
    done
  done
}

# cans_opening: a trileaflet valve in a duct of 6 x 3 x 3 cm opens in 40 ms, beginning at 10 ms. The pressure over the density is
# 1,260 cm^2/s^2, 1 mmHg of blood. R is 1e4 kg/(m s) over 1,060 kg/m^3, in cm^2/s.
cans_opening() {
  local way
  for way in sweeps-1 jump jump-sweeps-2 jump-cg-1 jump-cg-2 cg-4 cg-30; do
    cans_run "opening-$way" 1 valve 240 "kind = 'trileaflet', R = 94340, half_thickness = 0.14, place = 2.5, 1.5, 1.5,
  skirt_length = 1.2, opens_at = 0.01, opens_in = 0.04" "${cans_ways[$way]:-jump = F, cg = 30}" || return
  done
}

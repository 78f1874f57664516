# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run validate compile, compute, draw and write the page. `run` reads this file after
# examples/flow_fortran/flow.sh. The steps use the build folder of flow.sh, and the functions install_missing, is_on_offer,
# python_of_packages, say and step of `run`.

# Packages of Debian 12 or 13 that ./run validate needs, without recommends.
validate_packages=(gcc g++ gfortran cmake make libembree-dev libtbb-dev libopenmpi-dev libhypre-dev
  python3-numpy python3-scipy python3-matplotlib)

validate_compile() {
  cmake -S bench/validation -B "$flow_build/validation" -D CMAKE_PREFIX_PATH="$PWD/$flow_build/riis" \
    -D RIIS_VALIDATION_FLOW=ON &&
    cmake --build "$flow_build/validation" --parallel "$n_jobs"
}

# ./run validate [--short | --page | --all]
#   Compares flows that K determines with known solutions: Stokes flow through a hole and past a disc, plates that close a
#   channel or move in it, plane jets. In less than 20 minutes, the rows go to out/validate and into docs/validation.md. The
#   command fails if a row misses its bar, and is skipped if the distribution lacks libhypre-dev. --short uses coarse grids, takes
#   less than five minutes, and leaves everything in out/validate_short. --page computes nothing, and writes the page again from
#   out/validate/rows.json. --all first computes open leaflets in OpenFOAM, as walls in body-fitted meshes and as obstacles of
#   riis. This takes hours, and adds rows to bench/validation/all.json. Existing rows and complete cases stay, so --all can go on
#   after a stop.
run_validate() {
  local out=out/validate words=(--page docs/validation.md) python status=0
  case $* in
    '' | --all) ;;
    --short) out=out/validate_short words=(--short) ;;
    --page) words+=(--reuse) ;;
    *)
      echo "./run validate: '$*' is not an option" >&2
      exit 2
      ;;
  esac
  python=$(python_of_packages)
  if [[ ${1:-} == --page ]]; then
    [[ -f $out/rows.json ]] || { echo "./run validate --page: there is no $out/rows.json; ./run validate makes it" >&2; exit 2; }
    "$python" -B bench/validation/validate.py --out "$out" "${words[@]}"
    return
  fi
  if command -v dpkg-query >/dev/null && ! is_on_offer libhypre-dev; then
    say "validate is skipped: this distribution lacks the package libhypre-dev"
    return
  fi
  packages=("${validate_packages[@]}")
  install_missing
  # The processes of validate.py share the processors, so each has one thread.
  export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OMP_WAIT_POLICY=passive
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  if [[ ${1:-} == --all ]]; then
    install_missing "${openfoam_packages[@]}"
    (step "compute leaflets in body-fitted meshes and in those of riis" bench/validation/body_fitted.sh "$out/body_fitted") ||
      status=$?
    [[ ! -e $out/body_fitted/body_fitted.json ]] || cp "$out/body_fitted/body_fitted.json" bench/validation/all.json
    [[ ! -e $out/body_fitted/profiles.png ]] || cp "$out/body_fitted/profiles.png" docs/validation-offset.png
  fi
  step "compile the library" flow_compile
  step "compile the programs of the validation" validate_compile
  "$python" -B bench/validation/validate.py --marks "$flow_build/validation/validation_marks" \
    --flow "$flow_build/validation/validation_closed" --out "$out" "${words[@]}" || status=$?
  return "$status"
}

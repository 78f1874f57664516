# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# `run` reads this file for ./run bench. The file uses $build, $plot_packages and functions of `run`.

# Further competitors for ./run bench. If a competitor is missing, it is left out with a message.
bench_packages=(libcgal-dev libopenvdb-dev libmetis-dev "${plot_packages[@]}")
# Packages that ./run bench peers needs to install packages from PyPI. open3d's wheel needs the last two packages.
peers_packages=(python3-venv libusb-1.0-0 libgl1)

# ./run bench [short | full]
#   Builds and measures everything. The short variant takes a few minutes. The full variant takes twenty, with meshes of full size
#   and all numbers of threads. The results go to out/bench/*.json, and their numbers into docs/performance.md.
# ./run bench report
#   Measures nothing, and writes the numbers of out/bench/*.json into docs/performance.md.
# ./run bench search | marking | roofline | peers
#   search measures the searches on all sizes, beside the paper's tables. marking measures an adjacency and a time step, with
#   competitors such as CGAL's tree. roofline prints time, operations and bytes of each stage for each marked node, beside the
#   machine's limits. peers measures CGAL, VTK and OpenVDB. From PyPI it measures libigl, open3d, fcpw and point-cloud-utils.
# ./run bench costs [offset | measures] | leaks | moving | busy | ranks | scale [N [N [leaks]]]
#   costs prints the cost of each call. With a word it prints only the costs of a step with an offset, or of measures. leaks
#   prints how fine a mesh must be, for docs/meshes.md. moving compares velocity, fields and resistance with a plain time step.
#   busy measures steps beside two busy processes. ranks prints the cost on each rank of a mesh that METIS partitions, for
#   docs/solvers.md. scale marks millions of nodes in pieces, for docs/scale.md.
# ./run bench accuracy | proof
#   accuracy measures the errors of distances by triangles, samples and minimisation. It fails if an error is larger than its
#   promised bound. proof compares marks of a million nodes with a loop over triangles, with every instruction set and 1 to 4
#   threads. It also watches the memory of 10,000 time steps, and of 5,000 small markings by each search on a busy machine.
# ./run bench baseline FILE, ./run bench --compare FILE [--factor F]
#   baseline writes the guarded times and the machine's description into the file, such as bench/baselines/epyc-2.json.
#   --compare measures these times again, and fails if a time is longer by more than the factor F, by default 1.3. Times are
#   divided by the time of a calibration.
# ./run bench --benchmark_...
#   Passes these words to Google Benchmark itself, such as --benchmark_filter=mark.
run_bench() {
  local what=${1:-short} python
  python=$(python_of_packages)
  (($# == 0)) || shift
  case $what in
    short | full | search | marking | roofline | accuracy | peers | report | costs | leaks | moving | busy | ranks | scale | \
      proof)
      if [[ ! $what =~ ^(costs|leaks|moving|busy|ranks|scale)$ ]] && (($# > 0)); then
        refuse "'$what $*' has an argument too many"
      fi
      ;;
    baseline | --compare) (($# > 0)) || refuse "the argument FILE of $what is missing" ;;
    --*) ;;
    *) refuse "'$what' is not a part of the benchmarks" ;;
  esac
  [[ $what != peers ]] || bench_packages+=("${peers_packages[@]}")
  install_missing "${bench_packages[@]}"
  [[ $what == report ]] || build
  case $what in
    costs) "$build/bench/riis_costs" "$@" ;;
    leaks) "$build/bench/riis_bench_leaks" "$@" ;;
    moving) "$build/bench/riis_bench_moving" "$@" ;;
    busy) "$build/bench/riis_bench_busy" "$@" ;;
    ranks) "$build/bench/riis_bench_ranks" "$@" ;;
    scale) "$build/bench/riis_bench_scale" "$@" ;;
    proof)
      "$build/bench/riis_prove_marking"
      printf '\n'
      "$build/bench/riis_prove_memory"
      printf '\n'
      OMP_WAIT_POLICY=passive "$build/bench/riis_prove_search_memory"
      ;;
    report) "$python" -B bench/report/report.py ;;
    --compare) "$python" -B bench/report/study.py compare "$@" ;;
    --*) "$build/bench/riis_bench" "$what" "$@" ;;
    *) "$python" -B bench/report/study.py "$what" "$@" ;;
  esac
}

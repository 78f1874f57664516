# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run nek5000: copy the sources, compile, mesh, run, check, draw. `run` sources this file. The steps use $build,
# $packages, install_library, install_missing, python_of_packages, say, set_ranks and step of `run`.

nek_packages=(gcc g++ gfortran cmake make ninja-build pkg-config libembree-dev libtbb-dev openmpi-bin libopenmpi-dev gmsh
  python3-numpy python3-matplotlib)
nek_here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
nek_known=$nek_here/known.sha256

# ./run nek5000 FOLDER [--beat]
#   Runs valves in Nek5000, a spectral element code. A closed plate, upright and leaning, runs on 1, 2 and 4 ranks. A trileaflet
#   valve in a pipe is held closed and open, and runs while it opens, with a restart. FOLDER contains Nek5000 and gslib
#   (examples/nek5000/README.md), and is not changed. The command leaves a table in out/nek5000. --beat adds a beat of 0.8 s. If
#   Nek5000 is missing, the status is 77.
run_nek5000() {
  local beat='' python out=$PWD/out/nek5000
  case ${2:-} in
    '') ;;
    --beat) beat=yes ;;
    *)
      echo "./run nek5000: '$2' is not an option" >&2
      exit 2
      ;;
  esac
  nek_check_sources "${1:-}" || exit
  packages=("${nek_packages[@]}")
  install_missing
  python=$(python_of_packages)
  nek_work=$PWD/$build/nek5000
  nek_runs=$nek_work/runs
  rm -rf "$nek_runs" "$out"
  mkdir -p "$nek_runs" "$out"
  export NEK_SOURCE_ROOT=$nek_work/Nek5000 NEK_DEPS_LOCAL_SRC=1 PATH=$nek_work/Nek5000/bin:$PATH
  set_ranks
  step "copy the sources" nek_copy "$1"
  step "build the library with its Fortran modules" install_library "$nek_work" -D RIIS_WITH_FORTRAN=ON
  step "build the tools of Nek5000" nek_tools
  step "mesh the duct and the pipe" nek_meshes
  step "compile Nek5000 with 6 points along an element" nek_compile 6 9
  step "the closed plate, upright and leaning, on 1, 2 and 4 ranks" nek_plates
  step "the trileaflet valve, held closed and open" nek_held
  step "compile Nek5000 with 5 points along an element" nek_compile 5 8
  step "the valve opens, and a restart while it opens" nek_restart
  if [[ $beat ]]; then
    step "a beat of 0.8 s (the longest step)" nek_run beat 5 valve pipe8 1 userParam16=0.75
    "$python" -B "$nek_here/draw.py" "$nek_runs/beat" "$out/beat.png"
  fi
  "$python" -B "$nek_here/draw.py" "$nek_runs/whole" "$out/opening.png"
  "$python" -B "$nek_here/check.py" "$nek_runs" | tee "$out/checks.md"
  say "wrote the table and the picture of out/nek5000"
}

# nek_check_sources FOLDER: the status is 77 if FOLDER lacks the sources, and 1 if they are of another version.
nek_check_sources() {
  if [[ ! -f $1/Nek5000/core/drive1.f || ! -f $1/gslib/src/gs.c ]]; then
    echo "./run nek5000 FOLDER: skipped, FOLDER must hold Nek5000 41d17942 as Nek5000 and gslib 1.0.9 as gslib" \
      "(examples/nek5000/README.md, \"What to put into the folder\")" >&2
    return 77
  fi
  (cd "$1" && sha256sum --check --quiet --strict "$nek_known") || {
    echo "./run nek5000 FOLDER: this is not Nek5000 41d17942, the only version whose order of calls was checked" >&2
    return 1
  }
}

# nek_copy FOLDER: copies the sources, so that FOLDER is not changed. An existing copy is kept, with its compiled files.
nek_copy() {
  [[ -d $nek_work/Nek5000 ]] || {
    rm -rf "$nek_work/copy"
    mkdir -p "$nek_work/copy" &&
      cp -R "$1/Nek5000" "$nek_work/copy" &&
      mkdir -p "$nek_work/copy/Nek5000/3rd_party/gslib" &&
      cp -R "$1/gslib" "$nek_work/copy/Nek5000/3rd_party/gslib/gslib" &&
      mv "$nek_work/copy/Nek5000" "$nek_work/Nek5000" &&
      rmdir "$nek_work/copy"
  }
}

nek_tools() {
  (cd "$NEK_SOURCE_ROOT/tools" && ./maketools genbox genmap gmsh2nek)
}

# nek_meshes: the duct by genbox, and two pipes by gmsh: 8 layers of 20 elements for the beat, and 12 layers of 33 elements for
# the held valve. The tools of Nek5000 read their answers from the keyboard.
nek_meshes() {
  local layers n from to
  mkdir -p "$nek_work/mesh" && cd "$nek_work/mesh" || return
  genbox <<<"$nek_here/plate.box" && mv box.re2 plate.re2 && printf 'plate\n0.2\n' | genmap || return
  while read -r layers n from to; do
    gmsh -3 -nt 1 -setnumber n "$n" -setnumber nz "$layers" -setnumber z0 "$from" -setnumber z1 "$to" -o "pipe$layers.msh" \
      "$nek_here/pipe.geo" </dev/null &&
      printf '3\npipe%s\n0\n0\npipe%s\n' "$layers" "$layers" | gmsh2nek &&
      printf 'pipe%s\n0.01\n' "$layers" | genmap || return
  done <<<$'8 2 -2 3\n12 3 -2 4'
}

# nek_compile LX1 LXD: compiles the plate and the valve with LX1 points along each element, into $nek_work/LX1.
nek_compile() {
  local case folder=$nek_work/$1
  mkdir -p "$folder" && cd "$folder" || return
  # lgmres: GMRES restarts after lgmres iterations, and then forgets earlier directions. The number 30 in the template is too
  # small for a large K.
  sed -E "s/lx1=8/lx1=$1/; s/lxd=12/lxd=$2/; s/lelg=1000/lelg=400/; s/lx1m=1\)/lx1m=lx1)/; s/lgmres=30/lgmres=200/" \
    "$NEK_SOURCE_ROOT/core/SIZE.template" >SIZE.new &&
    { cmp -s SIZE.new SIZE || mv SIZE.new SIZE; } &&
    cp "$nek_here"/{RIISV,riis_nek.f,plate.usr,valve.usr} . || return
  export PKG_CONFIG_PATH=$nek_work/riis/lib/pkgconfig
  for case in plate valve; do
    export FFLAGS USR_LFLAGS
    FFLAGS=$(pkg-config --cflags riis-fortran) &&
      USR_LFLAGS="$(pkg-config --libs riis-fortran) -Wl,-rpath,$nek_work/riis/lib" &&
      nekconfig "$case" && nekconfig -build-dep && make -j "$n_jobs" && mv nek5000 "$case.nek" || return
  done
}

# nek_run NAME LX1 CASE MESH RANKS [KEY=VALUE...]: runs a case in $nek_runs/NAME with these entries in its .par.
nek_run() {
  local folder=$nek_runs/$1 program=$nek_work/$2/$3.nek case=$3 mesh=$4 ranks=$5 entry
  shift 5
  mkdir -p "$folder" && cd "$folder" &&
    cp "$nek_work/mesh/$mesh.re2" "$case.re2" && cp "$nek_work/mesh/$mesh.ma2" "$case.ma2" &&
    cp "$nek_here/$case.par" . && printf '%s\n%s/\n' "$case" "$PWD" >SESSION.NAME || return
  for entry; do
    grep -q "^${entry%%=*} = " "$case.par" && sed -i -E "s/^${entry%%=*} = [^ ]*/${entry%%=*} = ${entry#*=}/" "$case.par" ||
      return
  done
  timeout "${nek_limit:-7200}" mpirun -n "$ranks" "$program" >log 2>&1
}

# nek_plates: eps is twice the largest distance between points. Without u_surface, nothing changes after the first steps.
nek_plates() {
  local ranks
  nek_run plate_0 6 plate plate 1 userParam01=1e4 &&
    nek_run plate_0_stiff 6 plate plate 1 userParam01=1e5 || return
  for ranks in 1 2 4; do
    nek_run "plate_20_$ranks" 6 plate plate "$ranks" userParam01=1e4 userParam05=20 || return
  done
}

# nek_held: the closed valve holds 7.5 mmHg until its leak is steady; two openings are marked.
nek_held() {
  local opening pipe=(userParam01=1e4 userParam02=0.15 userParam12=-1.5 userParam13=3.5 userParam14=4 userParam15=0 userParam10=0)
  nek_run closed 6 valve pipe12 1 "${pipe[@]}" numSteps=15 userParam03=0 || return
  for opening in 0.02 0.5; do
    nek_run "held_$opening" 6 valve pipe12 1 "${pipe[@]}" numSteps=1 userParam03="$opening" userParam04=0 || return
  done
}

# nek_restart: the valve opens, and the run saves its state at step 60. Another run starts there. The projection of pressures uses
# more steps than the three saved ones, so these runs do not use it.
nek_restart() {
  nek_run whole 5 valve pipe8 1 numSteps=163 residualProj=no userParam08=60 userParam10=80 || return
  mkdir -p "$nek_runs/restart" && cp "$nek_runs"/whole/rs_valve0.f0000[123] "$nek_runs/restart" &&
    nek_run restart 5 valve pipe8 1 numSteps=103 residualProj=no userParam09=1
}

# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run demo, which reads this file: compile the program, make meshes, mark and draw, measure times, and print a
# summary. The steps use $build, $logs, $n_jobs, $demo_packages, install_missing and step of `run`.

# `run` has already refused the commands of this file if bash lacks associative arrays.
((BASH_VERSINFO[0] >= 4)) || return 0

# build_demo: compiles the program. If the folder is configured for the tests, it keeps this configuration, so that ./run test
# need not build everything again.
build_demo() {
  local less=(-D RIIS_WITH_FORTRAN=OFF -D RIIS_BUILD_TESTS=OFF)
  ! grep -qs '^RIIS_BUILD_TESTS:BOOL=ON' "$build/CMakeCache.txt" || less=()
  cmake --preset test "${less[@]}" &&
    cmake --build --preset test --parallel "$n_jobs" --target riis_program
}

# demo_mesh NAME [OPTION...]: makes the mesh of examples/demo/NAME.geo if it does not exist. The options are those of gmsh.
# examples/demo/fill.geo explains why the surface is first written to a file. gmsh runs with one thread, because several threads
# sometimes left stray cells in the mesh.
demo_mesh() {
  local mesh=$build/demo/$1 surface=examples/demo/$1.geo volume=examples/demo/fill.geo
  shift
  [[ ! -s $mesh.vtk || $surface -nt $mesh.vtk || $volume -nt $mesh.vtk ]] || return 0
  gmsh -2 -nt 1 "$@" -format msh2 -o "$mesh.msh" "$surface" &&
    gmsh -3 -nt 1 -format vtk -o "$mesh.vtk.part" "$mesh.msh" "$volume" &&
    mv "$mesh.vtk.part" "$mesh.vtk"
}

# demo_parts: compiles the program and makes the meshes at the same time.
demo_parts() {
  local meshing status=0
  mkdir -p out "$build/demo"
  { demo_mesh mitral_tube && demo_mesh aortic_root -setnumber coapting 1; } &
  meshing=$!
  build_demo || status=$?
  wait "$meshing" || status=$?
  return "$status"
}

# The valves of the demo, and the place of each valve. The valve that the demo calls aortic is the coapting valve in an aortic
# root. The stenotic valve is the aortic valve with a disease.
demo_valves=(aortic stenotic mitral)
declare -A demo_kind=([aortic]=coapting [stenotic]=aortic_stenosis_rheumatic [mitral]=mitral)
declare -A demo_place=([aortic]=aortic [stenotic]=aortic [mitral]=mitral)
demo_openings=(0 0.25 0.5 0.75 1)
# For each place: the mesh, and a point on each side of the valve. demo_states looks for a path between these points through the
# closed valve.
declare -A demo_mesh_of=([aortic]=aortic_root [mitral]=mitral_tube)
declare -A demo_from=([aortic]="0,0,-0.4" [mitral]="0,0.2,-1.3") demo_to=([aortic]="0,0,2.8" [mitral]="0,0.2,2.1")

# of_each_valve COMMAND: runs the command for all valves at the same time.
of_each_valve() {
  local valve status=0 pids=()
  for valve in "${demo_valves[@]}"; do
    "$1" "$valve" &
    pids+=($!)
  done
  for valve in "${pids[@]}"; do wait "$valve" || status=$?; done
  return "$status"
}

# demo_states VALVE: marks and draws the valve at each opening into out/VALVE_OPENING*, and writes the stats to build/demo. Also
# checks for paths through the closed valve.
demo_states() {
  local opening name place=${demo_place[$1]}
  for opening in "${demo_openings[@]}"; do
    name=$1_$opening
    "$build/bin/riis" mark "$build/demo/${demo_mesh_of[$place]}.vtk" --valve "${demo_kind[$1]}" --opening "$opening" \
      --output "out/$name.vtu" --surface-output "out/${name}_surface.vtp" --stats "$build/demo/$name.json" \
      --picture "out/${name}_side.png" --view side --picture "out/${name}_top.png" --view top || return
  done
  "$build/bin/riis" check leaks "$build/demo/${demo_mesh_of[$place]}.vtk" --valve "${demo_kind[$1]}" --opening 0 \
    --between "${demo_from[$place]}" "${demo_to[$place]}" --stats "$build/demo/$1_seal.json"
}

# demo_openings_picture: combines the marked cells of all states into one picture, with a row for each valve and view, and a
# column for each opening. Titles name the rows and columns.
demo_openings_picture() {
  local valve view opening inputs=() parts='' tiles='' layout='' titles='' n=0 row
  local -A seen_from=([side]='from the side' [top]='from above')
  for opening in "${demo_openings[@]}"; do
    titles+=",$(demo_title "opening $opening" "$((200 + n * 320 + 160))-text_w/2" 14)"
    n=$((n + 1))
  done
  n=0
  for valve in "${demo_valves[@]}"; do
    for view in side top; do
      row=$((n / 5))
      row=$((50 + row * 256 + 96))
      titles+=",$(demo_title "$valve" 14 "$row"),$(demo_title "${seen_from[$view]}" 14 $((row + 30)))"
      for opening in "${demo_openings[@]}"; do
        inputs+=(-i "out/${valve}_${opening}_$view.png")
        parts+="[$n]crop=iw/2:0.8*ih:iw/2:0.1*ih,scale=320:-1[t$n];"
        tiles+="[t$n]"
        row=$((n / 5))
        layout+="|$((n % 5 * 320))_$((row * 256))"
        n=$((n + 1))
      done
    done
  done
  ffmpeg -y -loglevel error "${inputs[@]}" -filter_complex \
    "$parts${tiles}xstack=inputs=$n:layout=${layout:1},pad=1800:1586:200:50:white$titles" -frames:v 1 out/openings.png
}

# demo_title TEXT X Y: prints ffmpeg's filter that writes the text.
demo_title() { printf "drawtext=text='%s':fontsize=26:fontcolor=0x333333:x=%s:y=%s" "$1" "$2" "$3"; }

demo_pictures() { of_each_valve demo_states && demo_openings_picture; }

demo_beats() { of_each_valve demo_beat; }

# demo_beat VALVE: makes a movie of one heartbeat with 24 frames, its first picture, the moving surface, and the orifice over
# time.
demo_beat() {
  local place=${demo_place[$1]}
  "$build/bin/riis" mark "$build/demo/${demo_mesh_of[$place]}.vtk" --valve "${demo_kind[$1]}" \
    --cycle "examples/demo/${place}_cycle.csv" --period 0.72 --interpolation cubic --times 0:0.69:0.03 \
    --surface-output "out/$1_beating.pvd" --movie "out/$1_beating.mp4" --frame-rate 12 \
    --picture "out/$1_beating.png" --series-table "out/$1_beating.csv" &&
    "$build/bin/riis" states "out/$1_states.csv" --valve "${demo_kind[$1]}" --count 21 &&
    orifice_over_time "$1" >"out/$1_orifice.csv"
}

# In a table of states, the orifice is the third column from the end. The perimeter and the effective area follow.
# orifice_over_time VALVE: prints the orifice at the times of the valve's heartbeat, interpolated linearly between the states of
# its table.
orifice_over_time() {
  LC_ALL=C awk -F , '
    FNR == 1 { next }
    FNR == NR { opening[++n] = $1; area[n] = $(NF - 2); next }
    FNR == 2 { print "time,opening,orifice_area" }
    FNR > 1 {
      for (i = 1; i < n - 1 && $2 > opening[i + 1]; ++i) {}
      share = ($2 - opening[i]) / (opening[i + 1] - opening[i])
      printf "%s,%s,%.4g\n", $1, $2, area[i] + share * (area[i + 1] - area[i])
    }' "out/$1_states.csv" "out/$1_beating.csv"
}

# of_beat VALVE COLUMN OPERATOR: prints the least (<) or the largest (>) number of a column of the beating valve's table.
of_beat() {
  LC_ALL=C awk -F , -v column="$2" -v operator="$3" '
    NR == 2 || (NR > 2 && (operator == "<" ? $column < best : $column > best)) { best = $column }
    END { print best }' "out/$1_beating.csv"
}

# number_of NAME KEY: prints a number of the program's stats, with commas between thousands.
number_of() { sed -n -E 's/^ *"'"$2"'": ([^,]*),?$/\1/p' "$build/demo/$1.json" | thousands; }

# thousands: puts commas between the thousands of the number that it reads.
thousands() { sed -E ':a; s/^([0-9]+)([0-9]{3})\b/\1,\2/; ta'; }

# milliseconds_of KEY...: prints the sum of the times of all KEYs in the stats of the timed marking.
milliseconds_of() {
  local key
  for key in "$@"; do number_of mitral_steps "$key"; done | LC_ALL=C awk '{ sum += $1 } END { printf "%.1f ms", 1000 * sum }'
}

# demo_row VALVE: prints the marked nodes and the orifice at each opening, as two lines of the summary's table.
demo_row() {
  local opening
  printf '  %-28s' "$1 valve, nodes marked"
  for opening in "${demo_openings[@]}"; do printf ' %7s' "$(number_of "$1_$opening" n_marked)"; done
  printf '\n  %-28s' '              orifice, cm2'
  for opening in "${demo_openings[@]}"; do
    LC_ALL=C awk -F , -v opening="$opening" 'FNR > 1 && $1 == opening { printf " %7.1f", $(NF - 2) }' "out/$1_states.csv"
  done
}

# demo_seal VALVE: prints whether unmarked nodes lead through the closed valve, or around it.
demo_seal() { printf '  %-14s %s, by riis check leaks' "$1 valve" "$(number_of "$1_seal" state | tr -d '"')"; }

# demo_beat_line VALVE: prints a line about the valve's heartbeat.
demo_beat_line() {
  printf '  %-14s %s to %s nodes marked, leaflets move at up to %.0f cm/s' "$1 valve" "$(of_beat "$1" 3 '<' | thousands)" \
    "$(of_beat "$1" 3 '>' | thousands)" "$(of_beat "$1" 4 '>')"
}

demo_story() {
  local step surface marks
  step=$(milliseconds_of seconds_surface seconds_search)
  surface=$(milliseconds_of seconds_surface)
  marks=$(milliseconds_of seconds_search)
  cat <<TEXT

gmsh has made meshes that the valves fill: an aortic root of $(number_of aortic_0 n_nodes) nodes, and a tube of
$(number_of mitral_0 n_nodes) nodes along the mitral annulus. riis has marked the nodes within
$(number_of aortic_0 half_thickness) cm of a leaflet. A flow solver resists the flow at these nodes. The stenotic valve is
the aortic valve with fused commissures, which riis calls ${demo_kind[stenotic]}.

$(printf '  %-28s' ''; printf ' %7s' closed "${demo_openings[@]:1:3}" open)
$(demo_row aortic)
$(demo_row stenotic)
$(demo_row mitral)

Do marked nodes part inflow from outflow at opening 0?

$(demo_seal aortic)
$(demo_seal stenotic)
$(demo_seal mitral)

A valve that moves is marked again in each time step. For the mitral valve a step takes $step
on one thread of this machine: $surface for the new surface, $marks for the marks. This is
the median of $(number_of mitral_steps n_steps) steps that open and close the valve by 2 %.

All valves through a heartbeat, 24 times:

$(demo_beat_line aortic)
$(demo_beat_line stenotic)
$(demo_beat_line mitral)

Movies: out/*_beating.mp4; for ParaView out/*_beating.pvd. Orifices over time: out/*_orifice.csv
Pictures of all valves at all openings, from the side and from above: out/openings.png
One by one, with their surfaces: out/aortic_*_side.png, out/aortic_*_top.png, and so on
Meshes and surfaces, for ParaView: out/*.vtu, out/*.vtp. Full tables: $logs/*.log
The program is $build/bin/riis. Next, a patient's valve (docs/patient.md):
  export PATH=$PWD/$build/bin:\$PATH
  python3 examples/patient/make_patient.py out/patient
  riis patient out/patient/root.stl out/patient/landmarks.mrk.json --output out/case --solver openfoam
TEXT
}

# ./run program
#   Installs the packages that the program riis needs, and builds the program, build/bin/riis, in two minutes on two processors.
run_program() {
  packages=("${demo_packages[@]}")
  install_missing
  step "compile the program" build_demo
  printf '%s\n' "" "The program is $build/bin/riis. To type riis, put it on the path:" \
    "  export PATH=$PWD/$build/bin:\$PATH"
}

# ./run demo
#   Builds the program, and meshes an aortic root and a mitral tube. The command marks a healthy and a stenotic aortic valve and a
#   mitral valve in these meshes, at five openings and through a heartbeat for movies. The command also times the steps of a
#   moving valve. Meshes, pictures and movies are left in out/.
run_demo() {
  packages=("${demo_packages[@]}")
  install_missing
  step "compile the program, mesh an aortic root and a mitral tube meanwhile" demo_parts
  # An empty DISPLAY demands a virtual display, on which pictures are the same everywhere.
  DISPLAY='' step "mark and draw the valves at five openings" demo_pictures
  DISPLAY='' step "move the valves through a heartbeat, for movies" demo_beats
  step "time the steps of a moving valve" "$build/bin/riis" mark "$build/demo/mitral_tube.vtk" --valve mitral \
    --opening 0 --threads 1 --steps 200 --stats "$build/demo/mitral_steps.json"
  demo_story
}

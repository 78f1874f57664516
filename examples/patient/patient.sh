# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run patient, which reads this file: follow docs/patient.md as a reader would, and check its claims; or do the
# same for random patients. The steps use $build, $demo_packages, build_demo, thousands, install_missing and step of `run` and of
# examples/demo/demo.sh.

patient_folder=out/patient

# ./run patient
#   Follows docs/patient.md: from a patient's segmented root and six landmarks to a beating valve in a graded mesh. The command
#   checks that the closed valve seals, and that no edge leaks at 11 openings. The mesh must have at most a quarter of the nodes
#   of a uniform mesh. The command leaves meshes, pictures and a movie in out/patient, in two minutes.
# ./run patient N
#   Leads N random patients, up to 99, from landmarks to marks, in fifteen seconds each. The command prints a table, and leaves
#   pictures of the closed valves in out/patients.
run_patient() {
  if (($# > 1)) || [[ ! ${1:-1} =~ ^[1-9][0-9]?$ ]]; then
    echo "./run patient: '$*' is not a number of patients from 1 to 99" >&2
    exit 2
  fi
  packages=("${demo_packages[@]}" python3)
  install_missing
  step "compile the program" build_demo
  if (($# == 0)); then
    step "follow docs/patient.md" python3 -B tests/docs/run_tutorial.py check docs/patient.md "$patient_folder" \
      "$PWD/$build/bin" "$PWD"
    patient_checks
    return
  fi
  random_patients "$1"
}

# of_patient FOLDER KEY: prints a number or a word of the report of riis patient.
of_patient() {
  local value
  value=$(sed -n -E 's/^ *"'"$2"'": "?([^",]*)"?,?$/\1/p' "$1/patient.json" | head -n 1)
  [[ $value ]] || { echo "$1/patient.json lacks $2" >&2; exit 1; }
  printf '%s' "$value"
}

# gap_of FOLDER KEY: prints a number of the gap between the closed valve and the wall.
gap_of() { sed -n -E '/"gap": \{/,/\}/s/^ *"'"$2"'": ([^,]*),?$/\1/p' "$1/patient.json"; }

# patient_claim CLAIM COMMAND...: prints the claim, and whether it holds according to the status of the command.
patient_claim() {
  local text=$1
  shift
  if "$@"; then
    printf '  %-5s %s\n' yes "$text"
  else
    printf '  %-5s %s\n' NO "$text"
    patient_failed=1
  fi
}

# patient_checks: checks the claims of docs/patient.md. Returns 1 if a claim does not hold.
patient_checks() {
  local case=$patient_folder/case graded uniform leaking closed open
  patient_failed=0
  graded=$(of_patient "$case" n_nodes)
  uniform=$(of_patient "$patient_folder/uniform" n_nodes)
  leaking=$(of_patient "$case" n_leaking_edges)
  closed=$(of_patient "$case" closed)
  open=$(of_patient "$case" open)
  echo
  patient_claim "$(thousands <<<"$graded") nodes of the graded mesh are at most a quarter of $(thousands <<<"$uniform")" \
    test $((4 * graded)) -le "$uniform"
  patient_claim "no edge leaks at 11 openings: $leaking do" test "$leaking" -eq 0
  patient_claim "the closed valve seals: the passage is $closed" test "$closed" = closed
  patient_claim "blood passes the open valve: the passage is $open" test "$open" = open
  printf '\n  From landmarks to a beat: %.0f s. Files and pictures: %s/\n' "$(of_patient "$case" seconds)" "$patient_folder"
  return "$patient_failed"
}

# random_patients N: leads N random patients from landmarks to marks, prints a table, and combines pictures of the closed valves
# into one picture. Returns 1 if riis patient stops, and if the attachment of any patient is too far from the patient's own:
# 0.1 mm with exact landmarks, 0.8 mm with noise.
random_patients() {
  local folder=out/patients seed row place inputs=() tiles='' layout='' n=0
  patient_failed=0
  rm -rf "$folder"
  for seed in $(seq "$1"); do
    step "patient $seed" random_patient "$seed" "$folder/$seed"
    inputs+=(-i "$folder/$seed/closed.png")
    tiles+="[$n]scale=320:-1,pad=iw:286:0:30:white,$(demo_title "patient $seed" "(w-text_w)/2" 4)[t$n];"
    place=$((n / 5))
    layout+="|$((n % 5 * 320))_$((place * 286))"
    n=$((n + 1))
  done
  printf '\n  %-4s  %-13s  %-18s  %-13s  %-14s\n' '' 'residual, mm' 'gap to wall, mm' 'attachment, mm' 'edges'
  printf '  %-4s  %-13s  %-18s  %-14s  %5s  %6s  %-6s  %-4s  %5s  %7s\n' \
    seed 'before  after' 'least  most  mean' 'noise  exact' 'in mm' nodes closed open leaks seconds
  for seed in $(seq "$1"); do
    row=$folder/$seed/case
    printf '  %4s  %6.2f %6.2f  %5.2f %5.2f %5.2f  %5.2f %7.2f  %5.3g  %6s  %-6s  %-4s  %5s  %7.0f\n' "$seed" \
      "$(of_patient "$row" rms)" "$(of_patient "$row" warped_rms)" \
      "$(gap_of "$row" least)" "$(gap_of "$row" most)" "$(gap_of "$row" mean)" \
      "$(< "$folder/$seed/noise.txt")" "$(< "$folder/$seed/exact.txt")" "$(of_patient "$row" band_edge)" \
      "$(of_patient "$row" n_nodes | thousands)" "$(of_patient "$row" closed)" "$(of_patient "$row" open)" \
      "$(of_patient "$row" n_leaking_edges)" "$(of_patient "$row" seconds)"
    LC_ALL=C awk 'FNR == NR { noise = $1 } END { exit !(noise <= 0.8 && $1 <= 0.1) }' \
      "$folder/$seed/noise.txt" "$folder/$seed/exact.txt" || patient_failed=1
  done
  if ((n > 1)); then
    ffmpeg -y -loglevel error "${inputs[@]}" -filter_complex \
      "$tiles$(printf '[t%d]' $(seq 0 $((n - 1))))xstack=inputs=$n:layout=${layout:1}:fill=white" -frames:v 1 "$folder/closed.png"
    printf '\n  All closed valves: %s/closed.png\n' "$folder"
  fi
  return "$patient_failed"
}

# attachment_of_patient SEED NOISE WARP FILE: places the valve by landmarks with this noise. Writes this distance into the file:
# 95 % of the valve's attachment lie within this distance of the patient's attachment.
attachment_of_patient() {
  local make=$here/examples/patient/make_patient.py
  python3 -B "$make" "$4.d" --random --seed "$1" --attachment 3 --noise "$2" &&
    "$riis" place "$4.d/landmarks.mrk.json" --valve coapting --warp "$3" --quiet --output "$4.d/placed.json" &&
    "$riis" surface --valve "$4.d/placed.json" --quiet --output "$4.d/closed.vtp" &&
    python3 -B "$make" . --random --seed "$1" --measure "$4.d/closed.vtp" >"$4"
}

# random_patient SEED FOLDER: the command of docs/patient.md for a random patient, with three more landmarks in each half cusp.
random_patient() {
  local here=$PWD riis=$PWD/$build/bin/riis
  mkdir -p "$2" && cd "$2" &&
    python3 -B "$here/examples/patient/make_patient.py" . --random --seed "$1" --attachment 3 &&
    "$riis" patient root.stl landmarks.mrk.json --output case &&
    "$riis" mark case/mesh.msh --valve case/placed.json --skirt 6 --wall case/wall.stl --opening 0 --quiet --picture closed.png \
      --view valve-top --picture-panels valve --picture-captions none --picture-size 640x512 &&
    attachment_of_patient "$1" 0.3 smoothed noise.txt && attachment_of_patient "$1" 0 exact exact.txt
}

# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run diseases, which reads this file. The steps use $build, $demo_packages, build_demo, install_missing, say and
# step of `run` and of examples/demo/demo.sh.

# ./run diseases
#   Draws the diseases of `riis help diseases` on one sheet, out/diseases.png. Each valve is drawn from above, closed and open. A
#   prolapse is drawn closed, from above and from the side.
run_diseases() {
  packages=("${demo_packages[@]}")
  install_missing
  step "compile the program" build_demo
  step "draw the diseases" diseases_sheet
  say "wrote out/diseases.png"
}

# diseases_sheet: draws the sheet, with four diseases in a row.
diseases_sheet() {
  local name second state opening view picture n=0 row inputs=() parts='' tiles='' layout=''
  mkdir -p out/diseases
  for name in $("$build/bin/riis" help diseases | grep -oE '^[a-z]+_[[:alnum:]_]+ '); do
    case $name in
      *_P2) second="0 side" ;;
      *_prolapse) second="0 oblique" ;;
      *) second="1 top" ;;
    esac
    for state in "0 top" "$second"; do
      read -r opening view <<<"$state"
      picture=out/diseases/${name}_${opening}_$view.png
      "$build/bin/riis" surface --valve "$name" --opening "$opening" --quiet --view "$view" --picture "$picture" \
        --picture-size 656x476 --picture-captions none || return
      inputs+=(-i "$picture")
      parts+="[$n]scale=164:-1[p$n];"
      n=$((n + 1))
    done
    parts+="[p$((n - 2))][p$((n - 1))]hstack,pad=328:137:0:18:white,drawtext=text='$name':x=6:y=2:fontsize=14[t$n];"
    tiles+="[t$n]"
    row=$(((n / 2 - 1) / 4))
    layout+="|$(((n / 2 - 1) % 4 * 328))_$((row * 137))"
  done
  ffmpeg -y -loglevel error "${inputs[@]}" -frames:v 1 \
    -filter_complex "$parts${tiles}xstack=inputs=$((n / 2)):layout=${layout:1}:fill=white" out/diseases.png
}

# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run paraview, which reads this file: make a bare Debian, install ParaView there, build the wheel for its Python,
# and check the plug-in. Debian's ParaView conflicts with the Python modules of libvtk9-dev, so it needs a separate system. The
# steps use variables and functions of ./run and of python/python.sh.

# Packages for the plug-in and its check, besides the packages that build the wheel.
paraview_packages=(paraview python3-paraview python3-numpy python3-pil)

# paraview_install: unpacks the wheel into a folder for pvpython, which takes numpy from Debian.
paraview_install() {
  rm -rf build-python/paraview
  "$python_folder/tools/bin/pip" install --no-deps --target build-python/paraview "$(echo "$python_folder"/repaired/riis-*.whl)"
}

# paraview_display COMMAND...: runs the command under a virtual display, where ParaView's Python finds riis. src/paraview is
# in its path for usercustomize.py.
paraview_display() {
  PYTHONPATH=$PWD/build-python/paraview:$PWD/src/paraview xvfb-run -a -s '-screen 0 1400x1000x24 -noreset' "$@"
}

# paraview_check: checks the plug-in in pvpython, and leaves pictures in out/paraview.
paraview_check() {
  rm -rf out/paraview
  mkdir -p out/paraview
  paraview_display pvpython examples/paraview/check.py out/paraview
}

# paraview_window: loads the plug-in in ParaView's window, and leaves a picture of the whole window. The commands in quotes run
# under the virtual display.
paraview_window() {
  local version home=$PWD/build-python/paraview-home
  # ParaView welcomes a new user with a window that would cover the other windows.
  version=$(dpkg-query -W -f '${Version}' paraview)
  mkdir -p "$home/.config/ParaView"
  printf '[General]\nGeneralSettings.ShowWelcomeDialog=false\n' >"$home/.config/ParaView/ParaView${version%%+*}.ini"
  export HOME=$home RIIS_PARAVIEW_OUT=$PWD/out/paraview RIIS_PARAVIEW_PLUGIN=$PWD/src/paraview/riis_paraview.py
  # shellcheck disable=SC2016
  paraview_display bash -c '
    paraview --script=examples/paraview/gui.py &
    window=$!
    for ((i = 0; i < 180; ++i)); do
      [[ ! -e $RIIS_PARAVIEW_OUT/READY ]] || break
      kill -0 "$window" || exit 1
      sleep 1
    done
    [[ -e $RIIS_PARAVIEW_OUT/READY ]] || exit 1
    sleep 10 # the window draws itself
    /usr/bin/python3 -c "
import os
from PIL import ImageGrab
ImageGrab.grab(xdisplay=os.environ[\"DISPLAY\"]).save(os.environ[\"RIIS_PARAVIEW_OUT\"] + \"/window.png\")"
    kill "$window"'
}

# paraview_inside: the steps in the bare Debian.
paraview_inside() {
  packages=("${python_packages[@]}" "${paraview_packages[@]}")
  install_missing
  step "build tools from PyPI" python_tools /usr/bin/python3
  step "build the wheel" python_wheel
  step "repair the wheel" python_repair
  step "unpack it for pvpython" paraview_install
  paraview_check
  step "ParaView's window" paraview_window
}

# ./run paraview [12 | 13]
#   Makes a bare Debian of this version (12) in build-paraview12/, or in the folder RIIS_ROOTS, with ParaView and the Python
#   package. The command checks the plug-in for ParaView there, and leaves pictures of the marks and of ParaView's window in
#   out/paraview. The command needs root or sudo, and is skipped without both.
run_paraview() {
  local version=${1:-12} suite folder status=0
  case $*/$version in
    inside/inside)
      paraview_inside
      return
      ;;
    */12) suite=bookworm ;;
    13/13) suite=trixie ;;
    *)
      echo "./run paraview: '$*' is not a version of Debian, 12 or 13" >&2
      exit 2
      ;;
  esac
  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    say "skipped: a Debian of its own takes root rights, and there is no sudo"
    exit 77
  fi
  folder=${RIIS_ROOTS:-.}/build-paraview$version
  tests/debian/in_root.sh "$suite" "$folder" paraview inside || status=$?
  mkdir -p out/paraview
  cp -r "$folder"/root/riis/out/paraview/. out/paraview/ 2>/dev/null || true
  ((status == 0)) || exit "$status"
  say "out/paraview has the pictures"
}

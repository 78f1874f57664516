# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The steps of ./run paraview, which reads this file: make a bare Debian, install ParaView there, build the wheel for its Python,
# and check the plug-in. Debian's ParaView conflicts with the Python modules of libvtk9-dev, so it needs a system of its own. The
# steps use variables and functions of ./run and of python/python.sh.

# Packages that the plug-in and its check need, besides those that build the wheel.
paraview_packages=(paraview python3-paraview python3-numpy xvfb xauth libgl1-mesa-dri)

# paraview_install: unpacks the wheel into a folder for pvpython, which takes numpy from Debian.
paraview_install() {
  rm -rf build-python/paraview
  "$python_folder/tools/bin/pip" install --no-deps --target build-python/paraview "$(echo "$python_folder"/repaired/riis-*.whl)"
}

# paraview_check: checks the plug-in under a virtual display, and leaves pictures in out/paraview.
paraview_check() {
  mkdir -p out/paraview
  PYTHONPATH=$PWD/build-python/paraview xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' \
    pvpython examples/paraview/check.py out/paraview
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
}

# paraview_example [12|13]
paraview_example() {
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

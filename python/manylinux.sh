#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cibuildwheel calls these commands in its container, whose system is not Debian (pyproject.toml, ./run python manylinux):
#   manylinux.sh prepare               installs TBB from PyPI, builds Embree from build-python/embree-source, and takes
#                                      build-python/json, in /opt
#   manylinux.sh repair WHEEL FOLDER puts TBB, libgomp and all licences into the wheel, and leaves the wheel in FOLDER
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# The version of nanobind must be the version in pyproject.toml, because licences.py reads its licence.
tools=("tbb-devel>=2021.8,<2023" "cmake>=3.25,<4" ninja auditwheel==6.8.2 wheel nanobind==2.15.0)

prepare() {
  local texts=/opt/embree/licences text
  /opt/python/cp312-cp312/bin/python -m venv /opt/tools
  /opt/tools/bin/pip install "${tools[@]}"
  PATH=/opt/tools/bin:$PATH CMAKE_PREFIX_PATH=/opt/tools python/embree.sh build build-python/embree-source /opt/embree
  text=$(find /opt/tools/lib/python3.12/site-packages/tbb-*.dist-info -iname 'LICENSE*' | head -n 1)
  cat "$text" >"$texts/libtbb.copyright"
  cp -r build-python/json/usr/* /opt/embree
  cp build-python/json/*.copyright "$texts"
  cat /usr/share/licenses/libgcc/COPYING3 /usr/share/licenses/libgcc/COPYING.RUNTIME >"$texts/libgomp.copyright"
}

repair() {
  local wheel=$1 folder=$2 work
  work=$(mktemp -d)
  PATH=/opt/tools/bin:$PATH auditwheel repair --wheel-dir "$work/repaired" "$wheel"
  /opt/tools/bin/wheel unpack --dest "$work/built" "$wheel"
  /opt/tools/bin/wheel unpack --dest "$work/unpacked" "$work"/repaired/*.whl
  /opt/tools/bin/python -B python/licences.py "$(echo "$work"/unpacked/*)" "$(echo "$work"/built/*/riis/_riis*.so)" \
    /opt/embree/licences
  /opt/tools/bin/wheel pack --dest-dir "$folder" "$(echo "$work"/unpacked/*)"
  rm -rf "$work"
}

case ${1:-}/$# in
  prepare/1) prepare ;;
  repair/3) repair "$2" "$3" ;;
  *)
    echo "manylinux.sh: usage: manylinux.sh prepare, or manylinux.sh repair WHEEL FOLDER" >&2
    exit 2
    ;;
esac

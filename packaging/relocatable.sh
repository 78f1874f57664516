#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# relocatable.sh FOLDER: makes riis-VERSION-linux-PROCESSOR.tar.xz in the folder, on Debian 12. The archive has the program, all
# its libraries except the C library, and what pictures without a display need. It runs wherever it is unpacked, without root
# rights.
#
# Debian's VTK draws by X and OpenGL. For OpenGL the archive has a Mesa of its own, without LLVM, which alone takes 117 MB. This
# Mesa draws by X alone, so it works with every X server. For a machine without a display the archive has Debian's Xvfb, which
# the program starts. Embree is the small one of Python's wheels (python/embree.sh).
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
# shellcheck source=python/python.sh
. python/python.sh
[[ $# == 1 ]] || { echo "usage: packaging/relocatable.sh FOLDER" >&2; exit 2; }
work=$PWD/build-program most_bytes=200000000
logs=$work/logs
version=$(sed -n 's/^version: //p' CITATION.cff)
name=riis-$version-linux-$(uname -m)
out=$(realpath -m -- "$1")
tree=$work/$name
mkdir -p "$logs" "$out"

# build_mesa: builds libGL.so.1 and its libglapi.so.0 from the sources of Debian's libgl1-mesa-dri, in the folder mesa. libGL.so.1
# draws by the processor, for X without GLX.
build_mesa() {
  local off options=(-Dbuildtype=release -Doptimization=2 -Dplatforms=x11 -Dglx=xlib -Dgallium-drivers=swrast -Dvulkan-drivers=
    -Dglvnd=false -Dosmesa=false -Dbuild-tests=false)
  for off in llvm egl gbm gles1 gles2 dri3 shader-cache valgrind libunwind zstd lmsensors gallium-vdpau gallium-va gallium-xa; do
    options+=("-D$off=disabled")
  done
  packaging/apt_fetch.sh source libgl1-mesa-dri "$work/mesa-source"
  rm -rf "$work/mesa"
  # Debian's own Python has the module mako, even if another python3 comes first.
  PATH=/usr/bin:$PATH meson setup "$work/mesa" "$work/mesa-source" "${options[@]}"
  ninja -C "$work/mesa"
  touch "$work/mesa/complete"
}

build_program() {
  cmake -S . -B "$work/riis" -G Ninja -D CMAKE_BUILD_TYPE=Release -D BUILD_SHARED_LIBS=OFF -D RIIS_WITH_FORTRAN=OFF \
    -D RIIS_BUILD_TESTS=OFF -D RIIS_BUILD_BENCH=OFF -D RIIS_UNITY_BUILD=ON -D RIIS_UNITY_CORE=ON \
    -D CMAKE_UNITY_BUILD_BATCH_SIZE=20 -D CMAKE_PREFIX_PATH="$PWD/$python_folder/embree" \
    -D embree_DIR="$(dirname "$(echo "$PWD/$python_folder"/embree/lib/cmake/embree-*/embree-config.cmake)")"
  cmake --build "$work/riis" --target riis_program --parallel "$(nproc)"
}

# relative FILE BEFORE AFTER: replaces a text of Xvfb, which is a folder of the system, by one that is relative to its own folder.
relative() {
  python3 - "$@" <<'PYTHON'
import pathlib
import sys

file, before, after = pathlib.Path(sys.argv[1]), sys.argv[2].encode(), sys.argv[3].encode()
text = b"\0" + before + b"\0"
found = file.read_bytes()
if found.count(text) != 1:
    raise SystemExit(f"relocatable.sh: {file} has {found.count(text)} times the text {before!r}, not once")
file.write_bytes(found.replace(text, b"\0" + after.ljust(len(before), b"\0") + b"\0"))
PYTHON
}

# libraries FILE...: prints the libraries that the files need, without those of the C library and of Mesa.
libraries() {
  local left_out='c|m|pthread|dl|rt|resolv|util|nsl|GL|glapi|GLX|OpenGL|GLdispatch'
  ldd "$@" | awk '$2 == "=>" { if ($3 !~ /^\//) { print "there is no " $1 > "/dev/stderr"; exit 1 } print $3 }' | sort -u |
    grep -v -E "/lib($left_out)\.so\.[0-9]+\$"
}

# licence FILE: keeps the licences of the package that has the file.
licence() {
  local package
  package=$(dpkg-query -S "*/$(basename "$(readlink -f "$1")")" | head -n 1 | cut -d : -f 1)
  cp "/usr/share/doc/$package/copyright" "$tree/share/doc/$package.copyright"
}

collect() {
  local file mesa=$work/mesa/src
  rm -rf "$tree"
  mkdir -p "$tree"/{bin,lib/path,share/doc,share/X11}
  strip -o "$tree/lib/riis" "$work/riis/bin/riis"
  cp /usr/bin/Xvfb /usr/bin/xkbcomp "$tree/lib"
  # Xvfb starts xkbcomp in the folder in which it runs itself.
  relative "$tree/lib/Xvfb" /usr/bin .
  cp -RL /usr/share/X11/xkb "$tree/share/X11/xkb"
  strip -o "$tree/lib/libGL.so.1" "$mesa"/gallium/targets/libgl-xlib/libGL.so.1.*.0
  strip -o "$tree/lib/libglapi.so.0" "$mesa/mapi/shared-glapi/libglapi.so.0.0.0"
  libraries "$work/riis/bin/riis" /usr/bin/Xvfb /usr/bin/xkbcomp "$tree/lib/libGL.so.1" >"$work/libraries.txt"
  while IFS= read -r file; do
    cp -L "$file" "$tree/lib"
    licence "$file"
  done <"$work/libraries.txt"
  for file in libGLX.so.0 libOpenGL.so.0; do ln -s libGL.so.1 "$tree/lib/$file"; done
  for file in libGL libX11-6 xvfb x11-xkb-utils xkb-data libgl1-mesa-dri libembree-dev; do
    [[ ! -f /usr/share/doc/$file/copyright ]] || cp "/usr/share/doc/$file/copyright" "$tree/share/doc/$file.copyright"
  done
  cp LICENSE "$tree/share/doc/riis.copyright"
  # All libraries are beside the program, and no others are taken, not even for libraries of libraries.
  patchelf --force-rpath --set-rpath "\$ORIGIN" "$tree"/lib/{riis,Xvfb,xkbcomp,libGL.so.1,libglapi.so.0}
  cat >"$tree/bin/riis" <<'SH'
#!/bin/sh
# The program riis. Without a display, pictures take the X server of this folder, unless the system has one.
here=$(dirname "$(dirname "$(readlink -f "$0")")")
PATH=$PATH:$here/lib/path exec "$here/lib/riis" "$@"
SH
  cat >"$tree/lib/path/Xvfb" <<'SH'
#!/bin/sh
# The X server of this folder.
cd "$(dirname "$(dirname "$(readlink -f "$0")")")" && exec ./Xvfb -xkbdir "$PWD/../share/X11/xkb" -extension GLX "$@"
SH
  chmod +x "$tree/bin/riis" "$tree/lib/path/Xvfb"
  mkdir -p "$tree/share/riis/examples"
  cp -R examples/patient examples/demo "$tree/share/riis/examples"
}

[[ -e $work/mesa/complete ]] || logged mesa build_mesa
logged embree python_embree
logged program build_program
logged collect collect
bytes=$(du -s --block-size=1 --apparent-size "$tree" | cut -f 1)
((bytes <= most_bytes)) || { echo "relocatable.sh: $name has $bytes bytes, more than $most_bytes" >&2; exit 1; }
logged pack tar -C "$work" --owner=0 --group=0 --numeric-owner --sort=name --mtime="@$(stat -c %Y CITATION.cff)" \
  -cJf "$out/$name.tar.xz" "$name"
say "$out/$name.tar.xz: $(size "$out/$name.tar.xz"), unpacked $(numfmt --to=si --suffix=B --format=%.1f "$bytes")"

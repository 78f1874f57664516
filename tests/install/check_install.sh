#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_install.sh SOURCE_DIR BUILD_DIR WORK_DIR shared|static [VTK] [Fortran] [program]
# Installs a build tree to a fresh prefix, and uses it as an outside project would. The programs of stranger/, one in each
# language, must mark the same bits as the build tree's C program. The prefix is then moved. Examples are built outside the tree
# by CMake, two of them also by pkg-config, and run. Each example must print the same in C and in Fortran. If the tree is also
# installed to a second prefix, all examples are built with the second prefix, and only two with the first prefix. A staged
# (DESTDIR) install must contain the same files and no path of its stage. Environment: CMAKE, PKG_CONFIG, CC, CXX, FC,
# TEST_PLUGIN, the path of the program test_plugin, and STRANGER, the path of the build tree's C program
set -euo pipefail
source=$1 build=$2 work=$3 kind=$4
shift 4
components=" $* "
has() { [[ $components == *" $1 "* ]]; }

problem() {
  echo "problem: $*" >&2
  exit 1
}

# Runs a command and shows its output only if it fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; problem "failed: $*"; }
}

c_flags=(-std=c99 -pedantic -Wall -Wextra -Werror)
fortran_flags=(-std=f2018 -Wall -Wextra -Werror)

# Lists all examples except those of MPI, which check_mpi_example.sh runs. A few examples need flags besides riis's flags. The
# additional flags follow the names of the examples.
all_examples=(first_marking prosthesis opening_valve pressure_opens cell_centres quadrature_points csr_from_elements
  single_precision openmp_caller overlap)
few_examples=(first_marking openmp_caller)
declare -A more_flags=([openmp_caller]=-fopenmp)

# shellcheck source=tests/fortran/page_sources.sh
. "$source/tests/fortran/page_sources.sh"

# Empties the build directory of a project, but keeps CMake's knowledge of the compilers. Examining three compilers takes longer
# than building a project.
empty_but_compilers() { # argument: build directory
  mkdir -p "$1/CMakeFiles"
  find "$1" -mindepth 1 -maxdepth 1 ! -name CMakeFiles -exec rm -rf {} +
  find "$1/CMakeFiles" -mindepth 1 -maxdepth 1 ! -name '[0-9]*' -exec rm -rf {} +
}

configure_consumer() { # arguments: source directory, build directory, prefix, more options
  local arguments=(-DCMAKE_PREFIX_PATH="$3" -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX"
    -DCMAKE_C_FLAGS="${c_flags[*]}")
  if has Fortran; then
    arguments+=(-DCMAKE_Fortran_COMPILER="$FC" -DCMAKE_Fortran_FLAGS="${fortran_flags[*]}")
  fi
  "$CMAKE" -S "$1" -B "$2" "${arguments[@]}" "${@:4}"
}

library_dir() { # argument: prefix
  dirname "$(dirname "$(find "$1" -name riis.pc)")"
}

# Returns whether an example also has a program in Fortran, and whether Fortran was built.
has_fortran_of() { # argument: name
  has Fortran && [ -e "$source/examples/$1.f90" ]
}

# Prints the text that an example must print.
expected_of() { # argument: name
  "$source/tests/install/expected_of.sh" "$1"
}

# An example must print the same text in C and in Fortran, with each way to build the example.
check_example() { # arguments: name, program
  "$2" >"$work/printed.txt" || problem "$2 failed"
  expected_of "$1" | diff - "$work/printed.txt" || problem "$2 does not print what it should"
}

# At each opening, the prosthesis of the example's JSON file must mark as many nodes as the example's program.
check_prosthesis_file() { # argument: the program
  local opening
  awk 'BEGIN {
    n = 27; n_nodes = n * n * n
    print "# vtk DataFile Version 3.0\nthe box of the example\nASCII\nDATASET UNSTRUCTURED_GRID"
    print "POINTS", n_nodes, "double"
    for (i = 0; i < n_nodes; ++i)
      print -1.625 + 0.125 * (i % n), -1.625 + 0.125 * (int(i / n) % n), -1 + 0.125 * int(i / (n * n))
    print "CELLS", n_nodes, 2 * n_nodes
    for (i = 0; i < n_nodes; ++i) print 1, i
    print "CELL_TYPES", n_nodes
    for (i = 0; i < n_nodes; ++i) print 1
  }' >"$work/box.vtk"
  for opening in 0.0 0.5 1.0; do
    "$1" mark "$work/box.vtk" --valve "$source/examples/prosthesis.json" --opening $opening --stats - |
      sed -n "s/.*\"n_marked\": \([0-9]*\).*/opening $opening, marked: \1/p"
  done >"$work/file.txt"
  expected_of prosthesis | grep '^opening' | diff - "$work/file.txt" || problem "prosthesis.json is not that of prosthesis.c"
}

check_by_cmake() { # arguments: prefix, all|few
  empty_but_compilers "$work/cmake"
  quietly configure_consumer "$source/examples" "$work/cmake" "$1"
  grep -q "^riis_DIR:PATH=$1/" "$work/cmake/CMakeCache.txt" || problem "another riis was found than that in $1"
  local example examples=("${all_examples[@]}") targets=()
  if [ "$2" = few ]; then
    examples=("${few_examples[@]}")
    targets=(--target first_marking_cpp "${examples[@]}")
    ! has Fortran || targets+=("${examples[@]/%/_fortran}")
  fi
  quietly "$CMAKE" --build "$work/cmake" "${targets[@]}"
  for example in "${examples[@]}"; do
    check_example "$example" "$work/cmake/$example"
    ! has_fortran_of "$example" || check_example "$example" "$work/cmake/${example}_fortran"
  done
  check_example first_marking "$work/cmake/first_marking_cpp"

  if has VTK; then
    empty_but_compilers "$work/cmake_vtk"
    quietly configure_consumer "$source/tests/install/consumer" "$work/cmake_vtk" "$1" -DWANTED='COMPONENTS;VTK'
    quietly "$CMAKE" --build "$work/cmake_vtk"
    quietly "$work/cmake_vtk/vtk_consumer"
  fi
  [ "$2" = all ] || return 0
  if ! has VTK; then
    quietly refused 'built without its component VTK' -DWANTED='COMPONENTS;VTK' "$1"
  fi
  has Fortran || quietly refused 'built without its component Fortran' -DWANTED='COMPONENTS;Fortran' "$1"
  quietly refused 'has no component "Nonsense"' -DWANTED='COMPONENTS;Nonsense' "$1"
  quietly refused 'requested version "1000"' -DWANTED=1000 "$1"
  if [ "$kind" = static ]; then
    quietly refused 'add CXX to the languages' -DLANGUAGES=C "$1"
  fi
}

# find_package must fail and say why.
refused() { # arguments: text, option, prefix
  empty_but_compilers "$work/refused"
  if configure_consumer "$source/tests/install/consumer" "$work/refused" "$3" "$2" >"$work/refused.txt" 2>&1; then
    echo "find_package was not refused: $2"
    return 1
  fi
  # CMake may break lines between any two words.
  tr -s ' \n' ' ' <"$work/refused.txt" | grep -q -F "$1" || { cat "$work/refused.txt"; return 1; }
}

flags() { # arguments: for pkg-config
  PKG_CONFIG_PATH=$pkg_config_path "$PKG_CONFIG" "$@"
}

# The flags of pkg-config are the same for all examples, so few examples are built. If all examples are requested, the program of
# an old code is also built.
check_by_pkg_config() { # arguments: prefix, all|few, more pkg-config options
  local pkg_config_path out=$work/pkg_config examples=("${few_examples[@]}")
  pkg_config_path=$(library_dir "$1")/pkgconfig
  rm -rf "$out"
  mkdir -p "$out"
  local example file more source_name
  # A compiler that cannot read the module files uses the installed sources instead. The Fortran sources contain no paths, so one
  # test is enough for all prefixes.
  if has Fortran && [ ! -d "$work/fortran" ]; then
    mkdir "$work/fortran"
    file=$(dirname "$(find "$1" -name riis_c.f90)")
    for source_name in "${fortran_sources[@]}"; do
      quietly "$FC" "${fortran_flags[@]}" -J "$work/fortran" -c "$file/$source_name.f90" -o "$work/fortran/$source_name.o"
    done
  fi
  if has Fortran && [ "$2" = all ]; then
    # Compiles the program like a code without modules.
    # shellcheck disable=SC2046
    quietly "$FC" -std=legacy "$source/tests/fortran/test_f77.f" "$source/tests/fortran/f77_checks.f" -o "$out/test_f77" \
      $(flags --cflags --libs "${@:3}" riis-fortran)
  fi
  for example in "${examples[@]}"; do
    file=$source/examples/$example
    more=${more_flags[$example]:-}
    # The flags stand without quotes, because they must split into words.
    # shellcheck disable=SC2046,SC2086
    quietly "$CC" "${c_flags[@]}" "$file.c" -o "$out/$example" $more $(flags --cflags --libs "${@:3}" riis)
    if has_fortran_of "$example"; then
      # shellcheck disable=SC2046,SC2086
      quietly "$FC" "${fortran_flags[@]}" "$file.f90" -o "$out/${example}_fortran" $more \
        $(flags --cflags --libs "${@:3}" riis-fortran)
      # shellcheck disable=SC2046,SC2086
      quietly "$FC" "${fortran_flags[@]}" -I "$work/fortran" "$file.f90" "$work/fortran"/*.o \
        -o "$out/${example}_source" $more $(flags --libs "${@:3}" riis)
    fi
  done
  local -x LD_LIBRARY_PATH
  LD_LIBRARY_PATH=$(library_dir "$1")
  for example in "${examples[@]}"; do
    check_example "$example" "$out/$example"
    if has_fortran_of "$example"; then
      check_example "$example" "$out/${example}_fortran"
      check_example "$example" "$out/${example}_source"
    fi
  done
  ! has Fortran || [ "$2" = few ] || quietly "$out/test_f77"
  if has VTK && [ "$kind" = shared ]; then
    # shellcheck disable=SC2046
    quietly "$CC" "${c_flags[@]}" "$source/tests/install/consumer/vtk_consumer.c" -o "$out/vtk_consumer" \
      $(flags --cflags --libs riis-vtk)
    quietly "$out/vtk_consumer"
  fi
}

# Runs the lines of README that compile and run an example. The reader of README has the library in $HOME/riis.
check_readme() { # argument: prefix
  local home=$work/home name
  rm -rf "$home"
  mkdir -p "$home/top"
  cp -R "$1" "$home/riis"
  ln -s "$source/examples" "$home/top/examples"
  awk '/^```sh/ { inside = 1; block = ""; next }
    inside && /^```/ { inside = 0; if (block ~ /^cmake --preset library/) printf "%s", block; next }
    inside { block = block $0 "\n" }' "$source/README.md" | grep -v '^cmake ' >"$home/lines.sh" ||
    problem "README.md has no lines that begin with cmake --preset library"
  for name in opening_c opening_f; do
    grep -q "./$name\$" "$home/lines.sh" || problem "the lines of README.md do not run $name"
  done
  (cd "$home/top" && env -u LD_LIBRARY_PATH -u PKG_CONFIG_PATH HOME="$home" bash -eu "$home/lines.sh") >"$home/printed.txt" ||
    problem "the lines of README.md failed"
  cat <(expected_of opening_valve) <(expected_of opening_valve) | diff - "$home/printed.txt" ||
    problem "the lines of README.md do not print what they should"
}

check_bits() { # argument: prefix
  local pkg_config_path out=$work/bits sources=$source/tests/install/stranger program programs=(c cpp)
  pkg_config_path=$(library_dir "$1")/pkgconfig
  rm -rf "$out"
  mkdir -p "$out"
  # The flags stand without quotes, because they must split into words.
  # shellcheck disable=SC2046
  quietly "$CC" "${c_flags[@]}" "$sources/marks.c" -o "$out/c" $(flags --cflags --libs riis)
  # shellcheck disable=SC2046
  quietly "$CXX" -std=c++17 -Wall -Wextra -Werror "$sources/marks.cpp" -o "$out/cpp" $(flags --cflags --libs riis)
  if has Fortran; then
    programs+=(fortran)
    # shellcheck disable=SC2046
    quietly "$FC" "${fortran_flags[@]}" "$sources/marks.f90" -o "$out/fortran" $(flags --cflags --libs riis-fortran)
  fi
  [ "$kind" != static ] || quietly "$source/tests/install/check_functions.sh" "$out/c"
  # shellcheck disable=SC2153
  "$STRANGER" >"$out/expected.txt"
  (($(wc -l <"$out/expected.txt") > 1000)) || problem "$STRANGER marks too few nodes"
  for program in "${programs[@]}"; do
    LD_LIBRARY_PATH=$(library_dir "$1") "$out/$program" | cmp "$out/expected.txt" - || problem "$out/$program marks other bits"
  done
}

# A plug-in that contains the static library exports only its own names. A program can unload the plug-in after the plug-in has
# marked nodes.
check_plugin() { # argument: prefix
  local pkg_config_path plugin=$work/plugin.so exported
  pkg_config_path=$(library_dir "$1")/pkgconfig
  # shellcheck disable=SC2046
  quietly "$CC" "${c_flags[@]}" -fPIC -shared -Wl,-z,nodelete "$source/tests/support/plugin.c" -o "$plugin" \
    $(flags --cflags --libs riis)
  exported=$(nm -D --defined-only "$plugin" | awk '{ print $3 }')
  grep -q '^plugin_mark$' <<<"$exported" || problem "$plugin does not export plugin_mark"
  ! grep '^riis_' <<<"$exported" || problem "$plugin exports the names of riis"
  quietly "$TEST_PLUGIN" "$plugin"
}

binaries() { # argument: prefix
  find "$1" -type f \( -name '*.so.*' -o -path '*/bin/*' \)
}

check_prefix() { # arguments: prefix, all|few (examples)
  local file
  while read -r file; do
    # Every installed file must find its libraries without LD_LIBRARY_PATH.
    if env -u LD_LIBRARY_PATH ldd "$file" | grep 'not found'; then
      problem "$file does not find the libraries that it needs"
    fi
  done < <(binaries "$1")
  check_by_cmake "$1" "$2"
  check_by_pkg_config "$1" "$2"
  if [ "$kind" = static ]; then
    check_by_pkg_config "$1" few --static
    check_plugin "$1"
  fi
  if [ "$kind" = shared ] && has Fortran && [ "$2" = all ]; then
    check_readme "$1"
  fi
  if has program; then
    quietly env -u LD_LIBRARY_PATH "$(find "$1" -name riis -type f)" --help
    check_prosthesis_file "$(find "$1" -name riis -type f)"
  fi
}

rm -rf "$work"
mkdir -p "$work"
prefix=$work/prefix

quietly "$CMAKE" --install "$build" --prefix "$prefix"
(cd "$prefix" && find . | sort) >"$work/files.txt"
if has Fortran; then
  { printf '%s.f90\n' "${fortran_sources[@]}" && echo riisf.h; } | sort >"$work/fortran_files.txt"
  (cd "$source/fortran" && printf '%s\n' *.f90 generated/* | sed 's,^generated/,,' | sort) | diff "$work/fortran_files.txt" - ||
    problem "the list in docs/building.md is not that of all Fortran sources"
  (cd "$(dirname "$(find "$prefix" -name riis_c.f90)")" && printf '%s\n' *.f90 riisf.h | sort) |
    diff "$work/fortran_files.txt" - || problem "not all Fortran sources are installed"
fi
if [ "$kind" = shared ]; then
  grep -q '/libriis\.so$' "$work/files.txt" || problem "no libriis.so is installed"
else
  grep -q '/libriis\.a$' "$work/files.txt" || problem "no libriis.a is installed"
fi

# No file may contain a path of the build or of the prefix.
if grep -r -I -F -e "$build" -e "$source/" -e "$prefix" "$prefix"; then
  problem "an installed text names a directory of the build or the prefix"
fi
while read -r file; do
  if readelf -d "$file" 2>/dev/null | grep -E 'R(UN)?PATH' | grep -F -e "$build" -e "$prefix"; then
    problem "$file looks for libraries in a directory of the build or the prefix"
  fi
done < <(binaries "$prefix")

# A global symbol without riis's name may clash with a symbol of the host program. Weak symbols, which come from templates, cannot
# clash, because linkers merge them.
while read -r file; do
  symbols=(nm -g --defined-only)
  [[ $file == *.a ]] || symbols=(nm -D --defined-only)
  if "${symbols[@]}" "$file" | awk 'NF == 3 && $2 !~ /[AVWu]/ { print $3 }' |
    grep -v -E '^(riisf?_|__riisf?_|_Z(T[ISV]|Z|GVZ?)?N[KV]*[0-9]+riis)'; then
    problem "$file has a global symbol without riis's name"
  fi
done < <(find "$prefix" -type f \( -name '*.so.*' -o -name '*.a' \))

# If a library directory is an absolute path, it does not move with the prefix. Everything must still be found. The check
# configures the build tree again. Only the test of static libraries configures again, because it has a separate build tree.
# Afterwards the test's fixture restores the build tree.
is_configured_anew='' examples_of_moved=all
if [ "$kind" = static ] && [[ $build == "$(dirname "$work")"/* ]]; then
  is_configured_anew=1 examples_of_moved=few
fi

check_bits "$prefix"
mv "$prefix" "$work/moved"
check_prefix "$work/moved" "$examples_of_moved"

quietly env DESTDIR="$work/stage" "$CMAKE" --install "$build" --prefix /opt/riis
(cd "$work/stage/opt/riis" && find . | sort) | diff "$work/files.txt" - || problem "a staged install has other files"
if grep -r -I -F "$work/stage" "$work/stage"; then
  problem "a staged file names the stage"
fi

if [ "$is_configured_anew" ]; then
  quietly "$CMAKE" -DCMAKE_INSTALL_PREFIX="$work/absolute" -DCMAKE_INSTALL_LIBDIR="$work/absolute/lib" "$build"
  quietly "$CMAKE" --build "$build"
  quietly "$CMAKE" --install "$build"
  check_prefix "$work/absolute" all
fi

awk '/^```text/ { inside = 1; next } /^```/ { inside = 0 } inside' "$source/examples/README.md" |
  diff - <(expected_of first_marking) || problem "examples/README.md does not show what first_marking prints"

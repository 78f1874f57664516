#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# darwin.sh SOURCE FOLDER
# Compiles the library, its VTK component, the program and the core's tests for macOS on arm64, and links them as the linker of
# macOS would. Nothing runs. The headers of macOS and libc++ come from the package ziglang. Some parts are stand-ins: the headers
# of Embree, TBB, VTK and the other libraries are Debian's. VTK's headers are therefore those of a VTK for X. The functions of the
# stand-ins stay undefined. The status is 77 if pip does not get the package.
set -euo pipefail
source=$1 folder=$2
version=0.13.0 # with clang 18, like Xcode 16

mkdir -p "$folder"/{bin,include,lib}
zig=$folder/zig-$version
if [[ ! -e $zig ]]; then
  python3 -m venv "$zig.partial"
  if ! "$zig.partial/bin/pip" install --quiet "ziglang==$version"; then
    echo "skipped: pip does not install ziglang $version, which has the headers of macOS" >&2
    exit 77
  fi
  mv "$zig.partial" "$zig"
fi
zig=$(echo "$zig"/lib/python3*/site-packages/ziglang)

# newest PATTERN: prints the path with the highest numbers.
newest() { compgen -G "$1" | sort -V | tail -n 1; }

llvm=$(newest '/usr/lib/llvm-*/bin/ld64.lld')
ln -sfn "${llvm%/*}" "$folder/llvm"

# The linker must not get libraries of Linux.
cat >"$folder/bin/ld64.lld" <<'END'
#!/bin/bash
words=()
for word; do
  [[ $word =~ \.so(\.[0-9.]+)?$ ]] || words+=("$word")
done
exec "${0%/*}/../llvm/ld64.lld" "${words[@]}"
END

# compiler NAME OPTION...: makes a compiler for macOS. The compiler does not search headers of Linux's C library.
compiler() {
  local name=$1
  shift
  cat >"$folder/bin/$name" <<END
#!/bin/bash
words=()
for word; do
  if [[ \$word == /usr/include && \${words[-1]-} == -isystem ]]; then
    unset 'words[-1]'
  elif [[ \$word != -I/usr/include ]]; then
    words+=("\$word")
  fi
done
exec "$zig/zig" clang -target arm64-apple-macos13.3 $* -nostdlibinc -isystem "$zig/lib/include" \\
  -isystem "$zig/lib/libc/include/any-macos-any" -mlinker-version=705 --ld-path="$folder/bin/ld64.lld" -L"$folder/lib" \\
  -Wno-unused-command-line-argument "\${words[@]}"
END
}
compiler clang
# zig lacks the file __config_site of libc++.
compiler clang++ --driver-mode=g++ -nostdinc++ -D_LIBCPP_ABI_VERSION=1 -D_LIBCPP_ABI_NAMESPACE=__1 \
  -D_LIBCPP_HARDENING_MODE=_LIBCPP_HARDENING_MODE_NONE -D_LIBCPP_PSTL_CPU_BACKEND_SERIAL \
  "-isystem '$zig/lib/libcxx/include' -isystem '$zig/lib/libcxxabi/include'"
# CMake sets run paths only if this program names a version.
printf '#!/bin/sh\necho 13.3\n' >"$folder/bin/sw_vers"
chmod +x "$folder"/bin/*

for name in /usr/include/{embree[34],tbb,oneapi,nlohmann,CLI,cmocka*} "$(newest '/usr/lib/llvm-*/lib/clang/*/include/omp.h')"; do
  [[ ! -e $name ]] || ln -sfn "$name" "$folder/include/${name##*/}"
done

: >"$folder/include/features.h" # a header of Linux, which Debian's HDF5 includes

# stand_in NAME PATH: makes a library without functions.
stand_in() {
  cat >"$folder/lib/lib$1.tbd" <<END
--- !tapi-tbd
tbd-version: 4
targets: [ arm64-macos ]
install-name: '$2'
exports:
  - targets: [ arm64-macos ]
    symbols: [ _no_function ]
...
END
}
stand_in c++ /usr/lib/libc++.1.dylib
stand_in omp /opt/homebrew/opt/libomp/lib/libomp.dylib
cp "$zig/lib/libc/darwin/libSystem.tbd" "$folder/lib"
for name in m pthread dl; do ln -sfn libSystem.tbd "$folder/lib/lib$name.tbd"; done

# CMake's batches of files and a low optimisation save time.
PATH=$folder/bin:$PATH cmake -S "$source" -B "$folder/build" -G Ninja \
  -D FOLDER="$folder" -D CMAKE_TOOLCHAIN_FILE="$source/tests/debian/darwin_toolchain.cmake" \
  -D CMAKE_BUILD_TYPE=Debug -D CMAKE_INSTALL_PREFIX="$folder/installed" -D RIIS_WARNINGS_AS_ERRORS=ON \
  -D RIIS_UNITY_BUILD=ON -D RIIS_UNITY_CORE=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=20 -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
  -D RIIS_KERNEL_LEVEL=-O0 -D RIIS_TESTS_LINK_WITH_GOLD=OFF \
  -D RIIS_WITH_FORTRAN=OFF -D RIIS_BUILD_TESTS=ON -D RIIS_BUILD_BENCH=OFF
cmake --build "$folder/build" --target riis riis_vtk riis_program riis_core_tests
cmake --install "$folder/build" >"$folder/install.log"

# The checks are: the exported names, the imported names, and how installed files name their libraries.
nm() { "$folder/llvm/llvm-nm" -jg "$@" | sort -u; }
fault() {
  echo "$1" >&2
  exit 1
}
for name in riis riis_vtk; do
  library=$(readlink -f "$folder/installed/lib/lib$name.dylib")
  expected=$(sed -nE 's/^(riis_[a-z0-9_]+) [0-9.]+$/_\1/p' "$source/abi/$name.symbols" | sort)
  differ=$(diff <(echo "$expected") <(nm --defined-only "$library")) ||
    fault "lib$name exports other functions than $source/abi/$name.symbols lists: $differ"
  [[ $("$folder/llvm/llvm-otool" -D "$library") == *"@rpath/lib$name.1.dylib"* ]] || fault "$library is not found by a run path"
  echo "lib$name.dylib exports $(wc -l <<<"$expected") functions, as on Linux"
done
# C++ names belong to libc++ or TBB, rtc to Embree, omp and kmpc to OpenMP.
nm --undefined-only "$(readlink -f "$folder/installed/lib/libriis.dylib")" |
  grep -vE '^(__Z|___cxa_|___gxx_personality|__Unwind|_rtc|_omp_|___kmpc_|dyld_stub_binder)' >"$folder/imported"
# shellcheck disable=SC2016 # names have this character
missing=$(grep -vxFf <(grep -oE '[A-Za-z_$0-9]+' "$folder/lib/libSystem.tbd") "$folder/imported") || true
[[ ! $missing ]] || fault "macOS lacks functions that libriis imports: $missing"
echo "libriis.dylib imports $(wc -l <"$folder/imported") functions of macOS, which has them"
loads=$("$folder/llvm/llvm-otool" -l "$folder/installed/bin/riis")
[[ $loads == *"path @loader_path/../lib "* ]] || fault "bin/riis has no run path to lib"
echo "bin/riis looks for its libraries in @loader_path/../lib"

# SPDX-License-Identifier: Apache-2.0
# Tells CMake how to compile for macOS on Debian (darwin.sh). FOLDER has the compilers, and the headers and libraries of
# stand-ins.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FOLDER)
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR arm64)
set(CMAKE_C_COMPILER ${FOLDER}/bin/clang)
set(CMAKE_CXX_COMPILER ${FOLDER}/bin/clang++)
foreach(tool ar ranlib nm install-name-tool)
  string(TOUPPER ${tool} name)
  string(REPLACE - _ name ${name})
  set(CMAKE_${name} ${FOLDER}/llvm/llvm-${tool})
endforeach()
set(CMAKE_LIBRARY_PATH ${FOLDER}/lib)
# CMake finds Debian's packages. The wrapper of the linker omits their libraries.
execute_process(COMMAND gcc -print-multiarch OUTPUT_VARIABLE CMAKE_LIBRARY_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE)
set(CMAKE_PREFIX_PATH /usr)
# The headers of the C library are macOS's, so /usr/include is never searched.
foreach(language C CXX)
  set(CMAKE_${language}_STANDARD_INCLUDE_DIRECTORIES ${FOLDER}/include)
  set(CMAKE_${language}_IMPLICIT_INCLUDE_DIRECTORIES /usr/include)
endforeach()
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-undefined dynamic_lookup")
endforeach()

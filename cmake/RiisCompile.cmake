# SPDX-License-Identifier: Apache-2.0
# How riis itself is compiled; nothing of this reaches those who link it.
add_library(riis_compile INTERFACE)
target_compile_options(riis_compile INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra -Wshadow -Wconversion>
  # Results are promised bit for bit: no contraction to fused multiply-add and none of fast-math, whatever the user's flags.
  $<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off -fno-fast-math>
  $<$<COMPILE_LANGUAGE:Fortran>:-Wall -Wextra -Wimplicit-interface>)
if(RIIS_WARNINGS_AS_ERRORS)
  target_compile_options(riis_compile INTERFACE -Werror)
endif()
if(RIIS_SANITIZE)
  # -fno-sanitize-recover: an undefined operation fails the test it happens in.
  target_compile_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE})
  # gfortran takes the address of an optional array that is absent before it asks whether it is there.
  target_compile_options(riis_compile INTERFACE $<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fno-sanitize=null>)
endif()
if(RIIS_SANITIZE MATCHES "thread")
  # The walk by threads that the sanitizer understands. Clang does not say in the way that gcc does that it sanitizes.
  target_compile_definitions(riis_compile INTERFACE RIIS_STD_THREADS $<$<C_COMPILER_ID:Clang>:__SANITIZE_THREAD__=1>)
endif()

# What every library of riis has in common: its version, and that it shows what the version script names and nothing else. (Hidden
# visibility leaves the C++ runtime's weak template instances visible; the version script does not.)
function(riis_finish_library target version_script)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  # A user's -ffast-math would link start-up code that sets flush-to-zero in whoever loads the library.
  target_link_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-fast-math>)
  if(BUILD_SHARED_LIBS)
    target_link_options(${target} PRIVATE "LINKER:--version-script=${version_script}")
    if(NOT RIIS_SANITIZE)  # a sanitizer's run-time stays undefined in the library
      target_link_options(${target} PRIVATE "LINKER:--no-undefined")
    endif()
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${version_script})
  endif()
endfunction()

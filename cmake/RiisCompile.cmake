# SPDX-License-Identifier: Apache-2.0
# Options for compiling riis itself. None of them reach its users.
add_library(riis_compile INTERFACE)
target_compile_options(riis_compile INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra -Wshadow -Wconversion>
  # Results are promised bit for bit, so there is no contraction to fused multiply-add and no fast-math, whatever the user's
  # flags.
  $<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off -fno-fast-math>
  $<$<COMPILE_LANGUAGE:Fortran>:-Wall -Wextra -Wimplicit-interface>)
if(RIIS_WARNINGS_AS_ERRORS)
  target_compile_options(riis_compile INTERFACE -Werror)
endif()
if(RIIS_SANITIZE)
  # -fno-sanitize-recover: an undefined operation fails the test it happens in. -g1: reports name files and lines. More would
  # double the time that gcc needs for the kernels.
  target_compile_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  target_link_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE})
  # The address sanitizer sees what this check of the size of an object sees. The kernels compile a third faster without it.
  if(RIIS_SANITIZE MATCHES "address")
    target_compile_options(riis_compile INTERFACE -fno-sanitize=object-size)
  endif()
  # gfortran takes the address of an absent optional array before it checks whether the array is present.
  target_compile_options(riis_compile INTERFACE $<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fno-sanitize=null>)
endif()
if(RIIS_SANITIZE MATCHES "thread")
  # Uses the walk by standard threads, which the sanitizer understands. gcc defines __SANITIZE_THREAD__ itself, Clang does not.
  target_compile_definitions(riis_compile INTERFACE RIIS_STD_THREADS $<$<C_COMPILER_ID:Clang>:__SANITIZE_THREAD__=1>)
endif()

# Gives a library of riis its version, and lets it export only the names of the version script. (Hidden visibility leaves the C++
# runtime's weak template instances visible, the version script does not.)
function(riis_finish_library target version_script)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  # A user's -ffast-math would link start-up code that sets flush-to-zero in every program that loads the library.
  target_link_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-fast-math>)
  if(BUILD_SHARED_LIBS)
    target_link_options(${target} PRIVATE "LINKER:--version-script=${version_script}")
    if(NOT RIIS_SANITIZE)  # with a sanitizer, its run-time stays undefined in the library
      target_link_options(${target} PRIVATE "LINKER:--no-undefined")
    endif()
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${version_script})
  endif()
endfunction()

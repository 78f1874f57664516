# SPDX-License-Identifier: Apache-2.0
# Sets options for compiling riis itself, which do not affect the users of riis.
add_library(riis_compile INTERFACE)
target_compile_options(riis_compile INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra -Wshadow -Wconversion>
  # In C++ gcc's -Wconversion leaves signs out, and clang's does not. With this option both report the same conversions.
  $<$<COMPILE_LANGUAGE:CXX>:-Wno-sign-conversion>
  # gcc 13 and 14 warn of a reference to a list's element, if a temporary object such as view(list) has returned it.
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-dangling-reference>
  # Results are promised bit for bit. So contraction to fused multiply-add and fast-math are off, even if the user's flags request
  # them.
  $<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off -fno-fast-math>
  $<$<COMPILE_LANGUAGE:Fortran>:-Wall -Wextra -Wimplicit-interface>)
if(RIIS_WARNINGS_AS_ERRORS)
  target_compile_options(riis_compile INTERFACE -Werror)
endif()
if(RIIS_SANITIZE)
  # -fno-sanitize-recover: an undefined operation fails the test in which it happens. -g1: reports name files and lines. More
  # debug information would double gcc's time for the kernels.
  # gfortran knows neither the fuzzer nor the check of casts. Its sanitized code calls clang's run-time as it calls its own.
  string(REGEX REPLACE ",(float-cast-overflow|fuzzer-no-link)" "" riis_fortran_sanitizers "${RIIS_SANITIZE}")
  target_compile_options(riis_compile INTERFACE $<$<COMPILE_LANGUAGE:C,CXX>:-fsanitize=${RIIS_SANITIZE}>
    $<$<COMPILE_LANGUAGE:Fortran>:-fsanitize=${riis_fortran_sanitizers}>
    -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  target_link_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE})
  # The fuzzer counts the branches that an input takes. It gives up the values of comparisons, because the tests share this build
  # and compare numbers most of the time.
  if(RIIS_SANITIZE MATCHES "fuzzer-no-link")
    target_compile_options(riis_compile INTERFACE
      $<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize-coverage=trace-cmp,indirect-calls>)
  endif()
  # The address sanitizer finds all errors that the check of object sizes finds. Without the check the kernels compile a
  # third faster.
  if(RIIS_SANITIZE MATCHES "address")
    target_compile_options(riis_compile INTERFACE -fno-sanitize=object-size)
  endif()
  if(RIIS_SANITIZE MATCHES "undefined")
    # An access through a null pointer ends the process without these checks too, and the tests' processors need no alignment.
    # The address sanitizer checks the accesses through pointers that overflow. Without these checks the core compiles in six
    # tenths of the time.
    target_compile_options(riis_compile INTERFACE -fno-sanitize=null,alignment,pointer-overflow)
    # Only tests are in C. Their own arithmetic is not checked, because oracles take most of the time of many tests. The address
    # sanitizer checks them, so it also notices arrays of the library that are shorter than told.
    string(REGEX REPLACE "address,|thread," "" riis_not_in_c "${RIIS_SANITIZE}")
    target_compile_options(riis_compile INTERFACE $<$<COMPILE_LANGUAGE:C>:-fno-sanitize=${riis_not_in_c}>)
  endif()
  # gfortran takes the address of an absent optional array before it checks whether the array is present. When such an array is
  # passed on, gfortran negates a stride that nobody has set: with the least integer on the stack, this overflows.
  target_compile_options(riis_compile INTERFACE $<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fno-sanitize=null,signed-integer-overflow>)
endif()
if(RIIS_SANITIZE MATCHES "thread")
  # Uses the walk by standard threads, which the thread sanitizer understands. gcc defines __SANITIZE_THREAD__ itself; Clang does
  # not.
  target_compile_definitions(riis_compile INTERFACE RIIS_STD_THREADS $<$<C_COMPILER_ID:Clang>:__SANITIZE_THREAD__=1>)
endif()

# Gives a library of riis its version, and lets it export only names that begin with its own.
function(riis_finish_library target)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  # A user's -ffast-math would link start-up code into the library. That code sets flush-to-zero in every program that loads the
  # library.
  target_link_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-fast-math>)
  if(BUILD_SHARED_LIBS)
    riis_export_own_names(${target})
  endif()
endfunction()

# SPDX-License-Identifier: Apache-2.0
# Sets riis_test_environment, which every test needs under the thread sanitizer.
set(riis_test_environment "")
if(NOT RIIS_SANITIZE MATCHES "thread")
  return()
endif()

# Archer tells the sanitizer in which order OpenMP makes threads access memory. OpenMP's run-time searches for Archer only in the
# program's paths, but Archer lies elsewhere. Suppressions name functions, so the sanitizer needs a symbolizer to find the names.
# Clang prints the folder of the symbolizer. ${CMAKE_CXX_COMPILER} cannot, because it may be ccache.
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-resource-dir OUTPUT_VARIABLE riis_clang_resources
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
find_library(RIIS_ARCHER archer HINTS ${riis_clang_resources}/../.. REQUIRED)
find_program(RIIS_SYMBOLIZER llvm-symbolizer HINTS ${riis_clang_resources}/../../../bin REQUIRED)

# Embree, TBB and OpenMP's run-time are not compiled with the sanitizer, so accesses inside them are ignored. A race is reported
# only while its earlier access is in the history, so the history has the greatest length. With the default length, the planted
# races were not reported.
set(riis_tsan_options ignore_noninstrumented_modules=1 history_size=7 external_symbolizer_path='${RIIS_SYMBOLIZER}'
  suppressions='${CMAKE_CURRENT_LIST_DIR}/suppressions.txt')
list(JOIN riis_tsan_options " " riis_tsan_options)
set(riis_test_environment "TSAN_OPTIONS=${riis_tsan_options}" "OMP_TOOL_LIBRARIES=${RIIS_ARCHER}")

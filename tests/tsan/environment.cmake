# SPDX-License-Identifier: Apache-2.0
# What every test needs under the thread sanitizer: riis_test_environment.
set(riis_test_environment "")
if(NOT RIIS_SANITIZE MATCHES "thread")
  return()
endif()

# Archer tells the sanitizer what OpenMP puts in an order; OpenMP's run-time looks for it along the program's paths only, where it
# is not. Suppressions name functions, so there has to be something that knows names.
file(REAL_PATH ${CMAKE_CXX_COMPILER} riis_clang)
cmake_path(GET riis_clang PARENT_PATH riis_clang_dir)
find_library(RIIS_ARCHER archer HINTS ${riis_clang_dir}/../lib REQUIRED)
find_program(RIIS_SYMBOLIZER llvm-symbolizer HINTS ${riis_clang_dir} REQUIRED)

# Embree, TBB and OpenMP's run-time are not compiled with the sanitizer: what they do themselves is left out. The longest history:
# a race whose earlier access is no longer in it goes unreported, as the planted ones did with the default.
set(riis_tsan_options ignore_noninstrumented_modules=1 history_size=7 external_symbolizer_path='${RIIS_SYMBOLIZER}'
  suppressions='${CMAKE_CURRENT_LIST_DIR}/suppressions.txt')
list(JOIN riis_tsan_options " " riis_tsan_options)
set(riis_test_environment "TSAN_OPTIONS=${riis_tsan_options}" "OMP_TOOL_LIBRARIES=${RIIS_ARCHER}")

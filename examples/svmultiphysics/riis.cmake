# SPDX-License-Identifier: Apache-2.0
# Makes riis the valve engine of svMultiPhysics, without a change of its sources. CMake includes this file in the solver's build:
#   cmake -S SOLVER/Code -B BUILD -D CMAKE_PROJECT_SV_INCLUDE=.../riis.cmake -D riis_DIR=PREFIX/lib/cmake/riis
# With `-U CMAKE_PROJECT_SV_INCLUDE` the next build makes the same program as before.
#   RIIS_URIS_CHECK  ON also compiles uris_check.cpp, which compares both engines in each step. Default OFF
option(RIIS_URIS_CHECK "riis: compare both valve engines in each step" OFF)

set(riis_engine_folder ${CMAKE_CURRENT_LIST_DIR})
# SHA-256 of the versions of uris.cpp whose functions uris_riis.cpp replaces.
set(riis_known_versions
  1e226b9a3e7f427a236a872984e0167b7e1522b07ccc5373656411ebf93e2eb5) # commit b5fbed0, July 2026

function(riis_replace_engine)
  get_target_property(folder svmultiphysics SOURCE_DIR)
  file(SHA256 ${folder}/uris.cpp version)
  if(NOT version IN_LIST riis_known_versions)
    message(FATAL_ERROR "riis.cmake knows the valve engine of svMultiPhysics b5fbed0, but not ${folder}/uris.cpp with the "
      "SHA-256 ${version}. If its functions uris_calc_sdf and eval_uris_ris_factors_quadrature are those of b5fbed0, add this "
      "number to riis_known_versions in ${riis_engine_folder}/riis.cmake.")
  endif()
  find_package(riis CONFIG REQUIRED)
  set_source_files_properties(${folder}/uris.cpp TARGET_DIRECTORY svmultiphysics PROPERTIES COMPILE_DEFINITIONS
    "uris_calc_sdf=sv_calc_sdf;eval_uris_ris_factors_quadrature=sv_factors")
  set(sources ${riis_engine_folder}/uris_riis.cpp)
  if(RIIS_URIS_CHECK)
    set_source_files_properties(${sources} TARGET_DIRECTORY svmultiphysics PROPERTIES COMPILE_DEFINITIONS
      "uris_calc_sdf=riis_calc_sdf;eval_uris_ris_factors_quadrature=riis_factors")
    list(APPEND sources ${riis_engine_folder}/uris_check.cpp)
  endif()
  # The include folder goes to our files only, and the library is given by its path. The target riis::riis would add the folder to
  # all files of the solver, and so compile all of them again.
  get_target_property(include riis::riis INTERFACE_INCLUDE_DIRECTORIES)
  get_target_property(library riis::riis LOCATION)
  set_source_files_properties(${sources} TARGET_DIRECTORY svmultiphysics PROPERTIES INCLUDE_DIRECTORIES "${include}")
  foreach(target svmultiphysics run_all_unit_tests)
    if(TARGET ${target})
      target_sources(${target} PRIVATE ${sources})
      target_link_libraries(${target} ${library})
    endif()
  endforeach()
endfunction()

cmake_language(DEFER CALL riis_replace_engine) # when the solver's targets exist

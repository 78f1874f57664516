# SPDX-License-Identifier: Apache-2.0
# Installs headers, libraries, program, Fortran module, CMake package and pkg-config files. They can be moved afterwards, since no
# installed file contains its own path. Files in an absolute CMAKE_INSTALL_LIBDIR or CMAKE_INSTALL_INCLUDEDIR are the exception.
include(CMakePackageConfigHelpers)

# ---------------------------------------------------------------------------------------------------------------------
# Files
# ---------------------------------------------------------------------------------------------------------------------

# Each component has its own export, so that a package may ship without some components.
set(riis_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/riis)
function(riis_install_library target)
  install(TARGETS ${target} EXPORT ${target}-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(EXPORT ${target}-targets NAMESPACE riis:: DESTINATION ${riis_cmake_dir})
endfunction()

# An installed file finds neighbouring files relative to its own folder. It finds Embree and VTK where they were at build time, if
# the system does not search there.
function(riis_set_rpath target from)
  if(NOT DEFINED CMAKE_INSTALL_RPATH)
    file(RELATIVE_PATH to_libraries ${from} ${CMAKE_INSTALL_FULL_LIBDIR})
    string(REGEX REPLACE "/$" "" origin "${riis_origin}/${to_libraries}")
    set_target_properties(${target} PROPERTIES INSTALL_RPATH ${origin})
  endif()
  set_target_properties(${target} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
endfunction()

riis_install_library(riis)
set_target_properties(riis PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
# riis.h names the other headers of the library.
file(STRINGS ${PROJECT_SOURCE_DIR}/include/riis/riis.h riis_headers REGEX "^#include \"")
list(TRANSFORM riis_headers REPLACE "#include \"(.*)\"" "\\1")
list(APPEND riis_headers riis.h riis.hpp)
list(TRANSFORM riis_headers PREPEND ${PROJECT_SOURCE_DIR}/include/riis/)
install(FILES ${riis_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/riis)

if(RIIS_WITH_VTK)
  riis_install_library(riis_vtk)
  riis_set_rpath(riis_vtk ${CMAKE_INSTALL_FULL_LIBDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/include/riis/riis_vtk.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/riis)
endif()

if(RIIS_WITH_FORTRAN)
  riis_install_library(riis_fortran)
  # The sources are installed with the module files. Users of another Fortran compiler have to compile only these sources.
  get_target_property(riis_fortran_sources riis_fortran SOURCES)
  list(TRANSFORM riis_fortran_sources PREPEND ${PROJECT_SOURCE_DIR}/fortran/ OUTPUT_VARIABLE riis_fortran_files)
  list(TRANSFORM riis_fortran_sources REPLACE "^generated/" "")
  list(FILTER riis_fortran_sources EXCLUDE REGEX "^riis_f77") # leaves out the external subroutines
  list(TRANSFORM riis_fortran_sources REPLACE "(.*)\\.f90"
    "$<TARGET_PROPERTY:riis_fortran,Fortran_MODULE_DIRECTORY>/\\1.mod" OUTPUT_VARIABLE riis_fortran_modules)
  install(FILES ${riis_fortran_files} ${PROJECT_SOURCE_DIR}/fortran/generated/riisf.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/riis)
  set(riis_module_dir ${RIIS_INSTALL_MODULE_DIR})
  if(NOT riis_module_dir)
    set(riis_module_dir ${CMAKE_INSTALL_INCLUDEDIR}/riis)
  endif()
  install(FILES ${riis_fortran_modules} DESTINATION ${riis_module_dir})
endif()

if(RIIS_BUILD_PROGRAM)
  install(TARGETS riis_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  riis_set_rpath(riis_program ${CMAKE_INSTALL_FULL_BINDIR})
endif()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)

# ---------------------------------------------------------------------------------------------------------------------
# Requirements of a static library on its users
# ---------------------------------------------------------------------------------------------------------------------

# Gets the imported targets that a target links and whose names have a prefix: "VTK::" gives "CommonCore;IOXML".
function(riis_linked_components target prefix result)
  get_target_property(linked ${target} LINK_LIBRARIES)
  list(FILTER linked INCLUDE REGEX "^${prefix}")
  list(TRANSFORM linked REPLACE "^${prefix}" "")
  set(${result} ${linked} PARENT_SCOPE)
endfunction()

get_target_property(riis_library_type riis TYPE)
riis_linked_components(riis TBB:: riis_tbb_components)
set(riis_vtk_components "")
set(riis_x11_components "")
if(RIIS_WITH_VTK)
  riis_linked_components(riis_vtk VTK:: riis_vtk_components)
  riis_linked_components(riis_vtk X11:: riis_x11_components)
endif()

# Gets a library's -L and -l flags from its full path. There is no -L for folders that the linker searches anyway.
function(riis_link_flags path result)
  cmake_path(GET path PARENT_PATH directory)
  cmake_path(GET path STEM name)
  string(REGEX REPLACE "^lib" "-l" flags ${name})
  if(NOT directory IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
    string(PREPEND flags "-L${directory} ")
  endif()
  set(${result} ${flags} PARENT_SCOPE)
endfunction()

# ---------------------------------------------------------------------------------------------------------------------
# CMake package
# ---------------------------------------------------------------------------------------------------------------------

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/riis-config.cmake.in ${PROJECT_BINARY_DIR}/riis-config.cmake
  INSTALL_DESTINATION ${riis_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# The compatibility follows the SONAME: within a major version, fields and functions are only appended.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/riis-config-version.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/riis-config.cmake ${PROJECT_BINARY_DIR}/riis-config-version.cmake
  DESTINATION ${riis_cmake_dir})

# ---------------------------------------------------------------------------------------------------------------------
# pkg-config
# ---------------------------------------------------------------------------------------------------------------------

# The prefix is relative to the .pc file's own folder, unless the library folder was given as an absolute path.
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
  set(riis_pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH riis_pc_up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" riis_pc_up ${riis_pc_up})
  set(riis_pc_prefix "\${pcfiledir}/${riis_pc_up}")
endif()
# cmake_path appends a relative folder to the prefix, and replaces the prefix by an absolute folder.
set(riis_pc_libdir "\${prefix}")
set(riis_pc_includedir "\${prefix}")
cmake_path(APPEND riis_pc_libdir ${CMAKE_INSTALL_LIBDIR})
cmake_path(APPEND riis_pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})

# A shared library loads its requirements itself. If there is only the static library, its requirements are in Libs, not in
# Libs.private, so that linking also works without --static.
set(riis_pc_static_libs "")
set(riis_pc_requires "")
if(NOT BUILD_SHARED_LIBS)
  get_target_property(riis_embree_file embree LOCATION)
  riis_link_flags(${riis_embree_file} riis_pc_static_libs)
  foreach(name IN LISTS OpenMP_CXX_LIB_NAMES)
    string(APPEND riis_pc_static_libs " -l${name}")
  endforeach()
  # Only the libraries of the C++ runtime are kept, because the compiler driver of any language adds the C runtime.
  set(riis_runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(FILTER riis_runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
  list(REMOVE_DUPLICATES riis_runtime)
  foreach(name IN LISTS riis_runtime)
    string(APPEND riis_pc_static_libs " -l${name}")
  endforeach()
  if(riis_tbb_components)
    set(riis_pc_requires tbb)
  endif()
endif()

# Writes and installs the pkg-config file of a library.
function(riis_add_pc_file name description requires libs cflags)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/pkg-config.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

riis_add_pc_file(riis "${PROJECT_DESCRIPTION}" "${riis_pc_requires}" "-lriis ${riis_pc_static_libs}" "-I\${includedir}")
if(RIIS_WITH_FORTRAN)
  set(riis_pc_modules "")
  if(RIIS_INSTALL_MODULE_DIR)
    set(riis_pc_modules "\${prefix}")
    cmake_path(APPEND riis_pc_modules ${RIIS_INSTALL_MODULE_DIR})
    string(PREPEND riis_pc_modules " -I")
  endif()
  riis_add_pc_file(riis-fortran "The Fortran module of riis" "riis = ${PROJECT_VERSION}" -lriis_fortran
    "-I\${includedir}/riis${riis_pc_modules}")
endif()
# VTK has no pkg-config files to which a static riis_vtk could refer. So a static riis_vtk can be found only by CMake.
if(RIIS_WITH_VTK AND BUILD_SHARED_LIBS)
  riis_add_pc_file(riis-vtk "The VTK component of riis: mesh and surface files, pictures" "riis = ${PROJECT_VERSION}" -lriis_vtk
    "-I\${includedir}")
endif()

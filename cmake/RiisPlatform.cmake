# SPDX-License-Identifier: Apache-2.0
# What the linkers of Linux and Darwin call differently. docs/macos.md lists the other files that differ.

# The folder of the file that looks for a library, in a run path.
set(riis_origin "$ORIGIN")
if(APPLE)
  set(riis_origin "@loader_path")
endif()

# Lets a shared library export only the names that begin with its own. (Hidden visibility alone would leave weak template
# instances of the C++ runtime visible.)
function(riis_export_own_names target)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}.map)
  if(APPLE)
    file(CONFIGURE OUTPUT ${list} CONTENT "_${target}_*\n")
    target_link_options(${target} PRIVATE "LINKER:-exported_symbols_list,${list}")
  else()
    string(TOUPPER ${target}_${PROJECT_VERSION_MAJOR} node)
    file(CONFIGURE OUTPUT ${list} CONTENT "${node} {\n  global: ${target}_*;\n  local: *;\n};\n")
    target_link_options(${target} PRIVATE "LINKER:--version-script=${list}")
    if(NOT RIIS_SANITIZE) # with a sanitizer, the sanitizer's run-time stays undefined in the library
      target_link_options(${target} PRIVATE LINKER:--no-undefined)
    endif()
  endif()
  set_target_properties(${target} PROPERTIES LINK_DEPENDS ${list})
endfunction()

# Keeps a library in memory after dlclose. On Darwin no option of the linker does that, and src/riis/parallel/threads.cpp does.
function(riis_stay_loaded target)
  if(NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:-z,nodelete)
  endif()
endfunction()

# Links a module of Python. The loader binds all names when the module is loaded. So the module uses one OpenMP run-time, even if
# a second one is loaded later. A static Embree, such as the wheel's (python/embree.sh), has functions that nothing calls.
function(riis_link_python_module target)
  if(APPLE)
    target_link_options(${target} PRIVATE LINKER:-dead_strip) # the loader binds all names in any case
  else()
    target_link_options(${target} PRIVATE LINKER:-z,now LINKER:--exclude-libs,ALL LINKER:--gc-sections)
  endif()
endfunction()

# ambrig_folder(NAME [ROOM] PUBLIC folders/libs... PRIVATE libs...): the static library of one folder.
# NAME is also the target's suffix: ambrig_core, ambrig_rotor, ... A folder whose rooms stand in
# different layers names them: ambrig_folder(analysis_linear ROOM analysis/linear ...), and the rest
# of the folder leaves that room out: EXCEPT analysis/linear.
set(AMBRIG_FOLDERS "")

# Headers that nearly every source reads are compiled once for all of them; with them come the decompositions and kernels
# of Eigen that core compiles once. Only the pages and answers of app and workbench are JSON: reading that header, a source
# makes its parser anew, used or not.
set(AMBRIG_COMMON_HEADERS <algorithm> <array> <cmath> <complex> <filesystem> <functional> <map> <memory> <optional>
                          <set> <string> <vector> <Eigen/Dense> <fmt/format.h>
                          ${CMAKE_SOURCE_DIR}/core/math/dense_templates.h)
set(AMBRIG_OFFLINE_HEADERS ${AMBRIG_COMMON_HEADERS})
set(AMBRIG_JSON_HEADERS ${AMBRIG_COMMON_HEADERS} <nlohmann/json.hpp>)
option(AMBRIG_PRECOMPILED_HEADERS "compile the common headers once" ON)

# Every object of the libraries is position-independent and shows its names to what it is linked with only, so that the
# program, the Python module (cmake/python.cmake) and the library of FMUs (cmake/fmu.cmake) are linked from one compilation.
# In a program the linker takes back what that costs: addresses and speed are those of objects compiled for a program.
function(ambrig_linked_everywhere target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
endfunction()

# ambrig_offline(TARGET): the target has no part in the simulation loop. It is optimised less, which takes two thirds of the
# time to compile and changes no result: no sum is reordered at any level (docs/decisions/005-build-time.md).
function(ambrig_offline target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# A unity build compiles several sources of a target as one: headers are read and templates made once
# for all of them (docs/decisions/005-build-time.md). Names of a folder's unnamed namespaces must then
# differ (tools/check_unity.py, run by ctest).
option(AMBRIG_UNITY "compile the sources of a folder together" OFF)
set(AMBRIG_UNITY_BATCH 40)       # sources, at most
if(AMBRIG_SANITIZE)
  set(AMBRIG_UNITY_BATCH 10)     # a unit of 40 takes 5 GB of the compiler's memory under the sanitizers
endif()
set(AMBRIG_UNITY_TEST_BATCH 12)  # tests repeat each other's names

# ambrig_unity(TARGET BATCH): all sources of the target, at most BATCH together, but
#   - those that choose their instruction set or are the fast loop, whose code must not hang on its neighbours,
#   - doors to libraries, whose macros stay behind the door,
#   - the catalogues, which tools/planted_change.py compiles once more.
function(ambrig_unity target most)
  if(NOT AMBRIG_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(together 0)
  foreach(source IN LISTS sources)
    if(source MATCHES "catalogue\\.cc$|/core/math/noise_|/noise_test\\.cc$|/core/math/(cvode|kinsol)\\.cc$|/ode_world\\.cc$"
       OR source MATCHES "/nlopt_search\\.cc$|/program_search\\.cc$|/discovery/search/fit\\.cc$|/formula_parser\\.cc$"
       OR source MATCHES "/core/record/(hdf5_|mat)[a-z_]*\\.cc$|/zip_file\\.cc$|/fmu/description\\.cc$|/synthesis/slicot\\.cc$")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    else()
      math(EXPR together "${together} + 1")
    endif()
  endforeach()
  # Units of the same size, so that no core waits for a last large one.
  math(EXPR units "(${together} + ${most} - 1) / ${most}")
  if(units GREATER 0)
    math(EXPR batch "(${together} + ${units} - 1) / ${units}")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

function(ambrig_folder name)
  cmake_parse_arguments(ARG "" "ROOM" "PUBLIC;PRIVATE;EXCEPT" ${ARGN})
  set(room ${name})
  if(ARG_ROOM)
    set(room ${ARG_ROOM})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/*.cc)
  foreach(other IN LISTS ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_SOURCE_DIR}/${other}/")
  endforeach()
  set(links "")
  foreach(link IN LISTS ARG_PUBLIC)
    if(TARGET ambrig_${link})
      list(APPEND links ambrig_${link})
    else()
      list(APPEND links ${link})
    endif()
  endforeach()
  add_library(ambrig_${name} STATIC ${sources})
  ambrig_linked_everywhere(ambrig_${name})
  target_include_directories(ambrig_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(ambrig_${name} PUBLIC ${links} PRIVATE ${ARG_PRIVATE})
  set(AMBRIG_FOLDERS "${AMBRIG_FOLDERS};ambrig_${name}" PARENT_SCOPE)
endfunction()

# ambrig_precompiled(TARGET common|offline|json): gives a target one of the sets of precompiled headers and their level of
# optimisation: -O3 with `common`, else ambrig_offline. g++ takes the level from the precompiled headers, whatever the command
# line says; all other options of a set's targets must be the same too.
function(ambrig_precompiled target set)
  if(NOT set STREQUAL "common")
    ambrig_offline(${target})
  endif()
  if(NOT AMBRIG_PRECOMPILED_HEADERS)
    return()
  endif()
  set(headers ambrig_${set}_headers)
  if(NOT TARGET ${headers})
    string(TOUPPER AMBRIG_${set}_HEADERS list)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${set}_headers.cc CONTENT "// Made by cmake/folders.cmake.\n")
    add_library(${headers} OBJECT ${CMAKE_BINARY_DIR}/${set}_headers.cc)
    ambrig_linked_everywhere(${headers})
    target_include_directories(${headers} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${headers} PRIVATE Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
    target_precompile_headers(${headers} PRIVATE ${${list}})
    if(NOT set STREQUAL "common")
      ambrig_offline(${headers})
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

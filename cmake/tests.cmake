# One test program per folder of tests/, from every *_test.cc in it; each TEST is a ctest case.
include(GoogleTest)
if(AMBRIG_PRECOMPILED_HEADERS)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/test_headers.cc CONTENT "// Made by cmake/tests.cmake.\n")
  add_library(ambrig_test_headers OBJECT ${CMAKE_BINARY_DIR}/test_headers.cc)
  target_link_libraries(ambrig_test_headers PRIVATE ambrig_app GTest::gmock)
  ambrig_offline(ambrig_test_headers)
  target_precompile_headers(ambrig_test_headers PRIVATE ${AMBRIG_JSON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
  # Chooses its instruction set before the first header.
  set_source_files_properties(${CMAKE_SOURCE_DIR}/tests/core/math/noise_test.cc PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()
# Folders whose tests need no other folder and no program: CI runs them under the sanitizers too (tools/run_tests.sh). With core
# come the readers of every file format.
set(AMBRIG_FAST_TESTS core)
add_custom_target(fast_tests)
file(GLOB test_folders RELATIVE ${CMAKE_SOURCE_DIR}/tests ${CMAKE_SOURCE_DIR}/tests/*)
foreach(folder IN LISTS test_folders)
  file(GLOB_RECURSE test_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${folder}/*_test.cc)
  if(folder STREQUAL "fmu" AND NOT TARGET ambrig_fmu_library)
    continue()  # not built with sanitizers (cmake/fmu.cmake)
  endif()
  if(test_sources)
    add_executable(test_${folder} ${test_sources})
    if(folder IN_LIST AMBRIG_FAST_TESTS)
      target_link_libraries(test_${folder} PRIVATE ambrig_${folder} GTest::gmock_main)
      add_dependencies(fast_tests test_${folder})
      set(labels LABELS fast)
    else()
      target_link_libraries(test_${folder} PRIVATE ambrig_app ${AMBRIG_FOLDERS} GTest::gmock_main)
      add_dependencies(test_${folder} ambrig)
      set(labels "")
    endif()
    target_compile_definitions(test_${folder} PRIVATE AMBRIG_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                               AMBRIG_BINARY="$<TARGET_FILE:ambrig>")
    ambrig_offline(test_${folder})
    ambrig_unity(test_${folder} ${AMBRIG_UNITY_TEST_BATCH})
    if(AMBRIG_PRECOMPILED_HEADERS)
      target_precompile_headers(test_${folder} REUSE_FROM ambrig_test_headers)
    endif()
    # A private Slurm beside other work misses its own time limits: the tests of campaigns go one by one.
    set(lock "")
    if(folder STREQUAL "campaign")
      set(lock RESOURCE_LOCK private_slurm)
    endif()
    gtest_discover_tests(test_${folder} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 600 ${labels} ${lock})
  endif()
endforeach()
# Controllers in C, and the program that runs them (cmake/controller_host.cmake).
target_compile_definitions(test_control PRIVATE AMBRIG_CONTROLLER_MODULES="${AMBRIG_CONTROLLER_MODULES}"
                           AMBRIG_CONTROLLER_HOST="$<TARGET_FILE:ambrig_controller_host>"
                           AMBRIG_C_COMPILER="${CMAKE_C_COMPILER}")
add_dependencies(test_control ambrig_controllers)
# The library that goes into FMUs (cmake/fmu.cmake).
if(TARGET ambrig_fmu_library)
  add_dependencies(test_fmu ambrig_fmu_library)
endif()
find_package(Python3 COMPONENTS Interpreter REQUIRED)
add_test(NAME layers COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_layers.py
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
# One file and one line for an effect, detector, fault, controller, bearing kind or command, as CONTRIBUTING.md says.
add_test(NAME planted_change COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/planted_change.py ${CMAKE_BINARY_DIR}
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(planted_change PROPERTIES TIMEOUT 600)
add_test(NAME layers_self_test COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_layers.py --self-test)
# What a unity build needs (AMBRIG_UNITY).
add_test(NAME unity_names COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_unity.py
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
# No file over 300 lines, no function over 60.
add_test(NAME sizes COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_sizes.py
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
# Tests lie where their sources do.
add_test(NAME tests_mirror COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_tests.py)
# One version, that of CMakeLists.txt.
add_test(NAME version COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_version.py)
# Equations in comments stand on lines of their own.
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${CMAKE_SOURCE_DIR}/.git)
  add_test(NAME comments COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_comments.py
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endif()
# The workbench: its scripts' types and computations, and a walk through its main flow in Chromium.
find_program(NODE node)
if(NODE AND EXISTS ${CMAKE_SOURCE_DIR}/web/node_modules/typescript)
  add_test(NAME workbench_types COMMAND ${NODE} node_modules/typescript/bin/tsc -p tsconfig.json
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}/web)
  add_test(NAME workbench_scripts COMMAND ${NODE} --test ${CMAKE_SOURCE_DIR}/tests/web/)
  add_test(NAME workbench_walk COMMAND ${NODE} ${CMAKE_SOURCE_DIR}/tests/workbench/walk.mjs $<TARGET_FILE:ambrig> ${CMAKE_SOURCE_DIR})
  set_tests_properties(workbench_walk PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 2400)
  # Frames, zoom, first paint, weight and memory: with AMBRIG_SLOW_TESTS=1 (nightly), and where nobody else keeps the cores busy.
  add_test(NAME workbench_budgets COMMAND ${NODE} ${CMAKE_SOURCE_DIR}/tests/workbench/budgets.mjs $<TARGET_FILE:ambrig> ${CMAKE_SOURCE_DIR})
  set_tests_properties(workbench_budgets PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 RUN_SERIAL ON)
endif()
# docs/third_party.md lists what is linked.
add_test(NAME third_party COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_third_party.py ${CMAKE_BINARY_DIR}
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
# The rigs that a person may copy.
add_test(NAME examples COMMAND ambrig check ${CMAKE_SOURCE_DIR}/examples --jobs 2)
# The pages that commands print are what the commands print.
add_test(NAME docs_parameters COMMAND sh -c "$<TARGET_FILE:ambrig> parameters --markdown | diff -u ${CMAKE_SOURCE_DIR}/docs/parameters.md -")
add_test(NAME docs_effects COMMAND sh -c "$<TARGET_FILE:ambrig> effects --markdown | diff -u ${CMAKE_SOURCE_DIR}/docs/effects.md -")
add_test(NAME docs_validation COMMAND sh -c "$<TARGET_FILE:ambrig> validate examples/validation --markdown | diff -u docs/validation.md -"
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
# Where the formatter of Debian 12 is installed (tools/setup.sh --tidy): another version formats otherwise.
find_program(CLANG_FORMAT clang-format-14)
if(CLANG_FORMAT)
  add_test(NAME format COMMAND sh -c "git ls-files '*.cc' '*.h' | xargs ${CLANG_FORMAT} --dry-run --Werror"
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endif()

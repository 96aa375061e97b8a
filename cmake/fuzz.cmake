# One program per tests/fuzz/*_fuzzer.cc, with libFuzzer (preset `fuzz`: clang, which has it; address and undefined-behaviour
# sanitizer). tools/fuzz_readers.py runs them.
option(AMBRIG_FUZZ "build the fuzz targets" OFF)
if(NOT AMBRIG_FUZZ)
  return()
endif()
# clang does not know g++'s pragma for a whole file's instruction set.
set_source_files_properties(${CMAKE_SOURCE_DIR}/core/math/noise_avx2.cc PROPERTIES COMPILE_OPTIONS "-mavx2;-maes")
set_source_files_properties(${CMAKE_SOURCE_DIR}/core/math/noise_vaes.cc PROPERTIES COMPILE_OPTIONS "-mavx2;-maes;-mvaes")
set_source_files_properties(${CMAKE_SOURCE_DIR}/core/math/noise_avx512.cc PROPERTIES COMPILE_OPTIONS
                            "-mavx512f;-mavx512vl;-mavx512dq;-mavx512bw;-maes;-mvaes")
file(GLOB fuzzers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/fuzz/*_fuzzer.cc)
add_custom_target(fuzzers)
foreach(source IN LISTS fuzzers)
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} EXCLUDE_FROM_ALL ${source})
  target_compile_definitions(${name} PRIVATE AMBRIG_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  # The libraries of the folders whose headers it includes: most readers are built without the rest.
  target_link_libraries(${name} PRIVATE ambrig_core)
  file(STRINGS ${source} includes REGEX "#include \"(campaign|control|design|discovery|effects|faulttolerance|fdd|rig|rotor|scenarios)/")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "#include \"([a-z]+)/.*" "\\1" folder "${include}")
    target_link_libraries(${name} PRIVATE ambrig_${folder})
  endforeach()
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  add_dependencies(fuzzers ${name})
endforeach()

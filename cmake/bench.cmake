file(GLOB_RECURSE bench_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/*.cc)
if(bench_sources)
  add_executable(ambrig_bench ${bench_sources})
  target_link_libraries(ambrig_bench PRIVATE ${AMBRIG_FOLDERS} benchmark::benchmark)
  target_compile_definitions(ambrig_bench PRIVATE AMBRIG_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                             AMBRIG_PROGRAM="$<TARGET_FILE:ambrig>")
endif()

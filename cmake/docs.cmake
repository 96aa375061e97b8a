# Target `docs`: pages, tables and figures of docs/ made anew from their commands. What they quote is
# compared by tests: cheap blocks always, those of minutes with AMBRIG_SLOW_TESTS=1 (nightly).
find_package(Python3 COMPONENTS Interpreter REQUIRED)
add_custom_target(docs
  COMMAND sh -c "$<TARGET_FILE:ambrig> parameters --markdown > docs/parameters.md"
  COMMAND sh -c "$<TARGET_FILE:ambrig> effects --markdown > docs/effects.md"
  COMMAND sh -c "$<TARGET_FILE:ambrig> validate examples/validation --markdown > docs/validation.md"
  COMMAND ${Python3_EXECUTABLE} tools/docs.py $<TARGET_FILE:ambrig>
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} DEPENDS ambrig VERBATIM)
add_test(NAME docs_blocks
         COMMAND ${Python3_EXECUTABLE} tools/docs.py $<TARGET_FILE:ambrig> --check
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
add_test(NAME docs_slow_blocks
         COMMAND sh -c "test -n \"$AMBRIG_SLOW_TESTS\" || exit 77; exec ${Python3_EXECUTABLE} tools/docs.py $<TARGET_FILE:ambrig> --check --slow"
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(docs_slow_blocks PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 7200)
# A few of the random scenarios (tools/random_scenarios.py -n 100000 takes hours).
add_test(NAME random_scenarios
         COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/random_scenarios.py $<TARGET_FILE:ambrig> -n 30 -j 2
         WORKING_DIRECTORY ${CMAKE_BINARY_DIR})
set_tests_properties(random_scenarios PROPERTIES TIMEOUT 900)
# A run of a day fits in memory: two short ones here, `--long 600` sharper.
add_test(NAME memory_growth
         COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/memory_growth.py $<TARGET_FILE:ambrig>)
# What the commands write as JSON fits its schema in schemas/; those that take minutes with AMBRIG_SLOW_TESTS=1.
add_test(NAME json_schemas COMMAND sh -c
         "test -z \"$AMBRIG_SLOW_TESTS\" || slow=--slow; exec ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/check_schemas.py $<TARGET_FILE:ambrig> $slow")
set_tests_properties(json_schemas PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 3600)

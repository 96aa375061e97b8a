# The Python module (cmake --preset python): python/module compiled to ambrig/_core and linked from the objects of the program,
# beside the sources of python/ambrig in build/release/python, ready to import; its tests in ctest.
option(AMBRIG_PYTHON "build the Python module" OFF)
if(NOT AMBRIG_PYTHON)
  return()
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module REQUIRED)
set(Python_EXECUTABLE ${Python3_EXECUTABLE})  # the same one, under the name that pybind11 asks for
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 REQUIRED)
set(package ${CMAKE_BINARY_DIR}/python/ambrig)
file(GLOB module_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/module/*.cc)
pybind11_add_module(ambrig_python MODULE NO_EXTRAS ${module_sources})
set_target_properties(ambrig_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package})
target_link_libraries(ambrig_python PRIVATE ambrig_app)
# Names of the libraries inside stay inside: another module may have its own of the same.
target_link_options(ambrig_python PRIVATE -Wl,--exclude-libs,ALL)
file(GLOB package_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/ambrig/*.py ${CMAKE_SOURCE_DIR}/python/ambrig/*.pyi
     ${CMAKE_SOURCE_DIR}/python/ambrig/py.typed)
add_custom_command(TARGET ambrig_python POST_BUILD
                   COMMAND ${CMAKE_COMMAND} -E copy_if_different ${package_sources} ${package})
file(GLOB python_tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/tests/test_*.py)
foreach(file IN LISTS python_tests)
  get_filename_component(name ${file} NAME_WE)
  add_test(NAME python_${name} COMMAND ${Python3_EXECUTABLE} ${file} -v WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}/python/tests)
  set_tests_properties(python_${name} PROPERTIES TIMEOUT 900
    ENVIRONMENT "PYTHONPATH=${CMAKE_BINARY_DIR}/python;AMBRIG_BINARY=$<TARGET_FILE:ambrig>")
endforeach()

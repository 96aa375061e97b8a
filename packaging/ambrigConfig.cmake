# find_package(ambrig): for controllers in C that ambrig runs (docs/guide/controller_in_c.md).
#
#   find_package(ambrig REQUIRED)
#   ambrig_add_controller(my_controller my_controller.c)      -> my_controller.so
#
# ambrig::controller is the header, ambrig::ambrig the program.
get_filename_component(AMBRIG_PREFIX "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET ambrig::controller)
  add_library(ambrig::controller INTERFACE IMPORTED)
  set_target_properties(ambrig::controller PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${AMBRIG_PREFIX}/include/ambrig")
  add_executable(ambrig::ambrig IMPORTED)
  set_target_properties(ambrig::ambrig PROPERTIES IMPORTED_LOCATION "${AMBRIG_PREFIX}/bin/ambrig")
endif()

# A shared library NAME.so from these sources, rounded as ambrig rounds.
function(ambrig_add_controller name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so)
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  target_link_libraries(${name} PRIVATE ambrig::controller m)
endfunction()

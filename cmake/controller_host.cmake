# The program in which controllers in C run (control/external/host): a small C program without any library of ours,
# put into ambrig_control by an assembler file, so that whatever links ambrig can start it (control/external/host_image.h).
enable_language(ASM)
file(GLOB host_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/control/external/host/*.c)
add_executable(ambrig_controller_host ${host_sources})
set_target_properties(ambrig_controller_host PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF
                      C_COMPILER_LAUNCHER "${CMAKE_CXX_COMPILER_LAUNCHER}")
target_compile_definitions(ambrig_controller_host PRIVATE _GNU_SOURCE)
target_include_directories(ambrig_controller_host PRIVATE ${CMAKE_SOURCE_DIR}/control/external)
target_link_libraries(ambrig_controller_host PRIVATE ${CMAKE_DL_LIBS} -pthread)
# A crash of a controller must stay a crash, not a report of the sanitizer.
target_compile_options(ambrig_controller_host PRIVATE -fno-sanitize=all)
target_link_options(ambrig_controller_host PRIVATE -fno-sanitize=all)
set(image ${CMAKE_BINARY_DIR}/controller_host.S)
file(CONFIGURE OUTPUT ${image} CONTENT "/* Made by cmake/controller_host.cmake. */
    .section .rodata
    .global ambrig_controller_host_begin, ambrig_controller_host_end
    .global ambrig_controller_header_begin, ambrig_controller_header_end
ambrig_controller_host_begin:
    .incbin \"${CMAKE_BINARY_DIR}/ambrig_controller_host\"
ambrig_controller_host_end:
    .byte 0
ambrig_controller_header_begin:
    .incbin \"${CMAKE_SOURCE_DIR}/control/external/ambrig_controller.h\"
ambrig_controller_header_end:
    .byte 0
    .section .note.GNU-stack,\"\",%progbits
" @ONLY)
set_source_files_properties(${image} PROPERTIES OBJECT_DEPENDS
  "${CMAKE_BINARY_DIR}/ambrig_controller_host;${CMAKE_SOURCE_DIR}/control/external/ambrig_controller.h")
target_sources(ambrig_control PRIVATE ${image})
add_dependencies(ambrig_control ambrig_controller_host)

# The controllers of examples/controllers and those of the tests, as a user compiles them.
set(AMBRIG_CONTROLLER_MODULES ${CMAKE_BINARY_DIR}/controllers)
file(GLOB controllers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/examples/controllers/*.c
     ${CMAKE_SOURCE_DIR}/tests/control/external/controllers/*.c ${CMAKE_SOURCE_DIR}/tests/control/external/controllers/*.cc
     ${CMAKE_SOURCE_DIR}/tests/control/external/fmus/*.c)
add_custom_target(ambrig_controllers)
foreach(source IN LISTS controllers)
  get_filename_component(name ${source} NAME_WE)
  add_library(controller_${name} MODULE EXCLUDE_FROM_ALL ${source})
  set_target_properties(controller_${name} PROPERTIES C_STANDARD 99 PREFIX "" SUFFIX .so OUTPUT_NAME ${name}
                        LIBRARY_OUTPUT_DIRECTORY ${AMBRIG_CONTROLLER_MODULES})
  target_include_directories(controller_${name} PRIVATE ${CMAKE_SOURCE_DIR}/control/external)
  target_compile_options(controller_${name} PRIVATE -fno-sanitize=all)
  target_link_options(controller_${name} PRIVATE -fno-sanitize=all)
  target_link_libraries(controller_${name} PRIVATE m)
  add_dependencies(ambrig_controllers controller_${name})
endforeach()

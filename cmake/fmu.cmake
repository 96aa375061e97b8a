# The library of every FMU that `ambrig export --fmu` makes: ambrig_fmu.so, found beside the program or in ../lib/ambrig.
#
# It is linked from the objects of the program (ambrig_linked_everywhere), with every symbol hidden but fmi2* and fmi3*
# (visible.map). Nothing is compiled twice.
# SUNDIALS and libstdc++ are linked statically; what has no such library is left out (fmu/library/left_out.cc). NLopt, which
# Debian has as a shared library only, goes into the FMU beside it ($ORIGIN).
option(AMBRIG_FMU "build the library of exported FMUs" ON)
if(NOT AMBRIG_FMU OR AMBRIG_SANITIZE)
  return()
endif()
file(GLOB library_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/fmu/library/*.cc)
add_library(ambrig_fmu_library MODULE ${library_sources})
set_target_properties(ambrig_fmu_library PROPERTIES OUTPUT_NAME ambrig_fmu PREFIX "" LINK_DEPENDS ${CMAKE_SOURCE_DIR}/fmu/library/visible.map)
set(archives "")
foreach(folder fmu simulation scenarios faulttolerance fdd rig analysis_linear effects control rotor rotor_shaft actuators core core_math)
  list(APPEND archives $<TARGET_FILE:ambrig_${folder}>)
  add_dependencies(ambrig_fmu_library ambrig_${folder})
endforeach()
set_property(TARGET ambrig_fmu_library APPEND PROPERTY LINK_DEPENDS "${archives}")
target_include_directories(ambrig_fmu_library PRIVATE ${CMAKE_SOURCE_DIR})
target_include_directories(ambrig_fmu_library SYSTEM PRIVATE
  $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES> $<TARGET_PROPERTY:nlohmann_json::nlohmann_json,INTERFACE_INCLUDE_DIRECTORIES>)
target_compile_options(ambrig_fmu_library PRIVATE -fvisibility=hidden)
set_source_files_properties(${CMAKE_SOURCE_DIR}/fmu/library/statically_linked.cc PROPERTIES COMPILE_OPTIONS -w
                            COMPILE_DEFINITIONS TOML_HEADER_ONLY=0)
target_link_options(ambrig_fmu_library PRIVATE -static-libstdc++ -static-libgcc -Wl,--gc-sections -Wl,--as-needed -Wl,-z,defs
                    -Wl,--version-script=${CMAKE_SOURCE_DIR}/fmu/library/visible.map -s)
set_target_properties(ambrig_fmu_library PROPERTIES BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN" BUILD_WITH_INSTALL_RPATH ON)
target_link_libraries(ambrig_fmu_library PRIVATE -Wl,--start-group ${archives} -Wl,--end-group
  -Wl,-Bstatic sundials_cvode sundials_arkode sundials_kinsol sundials_nvecserial sundials_generic -l:libpugixml.a -Wl,-Bdynamic
  PkgConfig::NLOPT m dl pthread)

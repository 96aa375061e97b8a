# find_package(ambrig): for controllers in C that ambrig runs (docs/guide/controller_in_c.md).
#
#   find_package(ambrig REQUIRED)
#   ambrig_add_controller(my_controller my_controller.c)      -> my_controller.so
#
# ambrig::controller is the header, ambrig::ambrig the program.
#
# find_package(ambrig COMPONENTS library): for programs in C++ that simulate (docs/guide/install.md).
#
#   find_package(ambrig REQUIRED COMPONENTS library)
#   target_link_libraries(my_program PRIVATE ambrig::library)
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

# What the archive is linked with, found as ambrig's own build finds it.
if("library" IN_LIST ambrig_FIND_COMPONENTS AND NOT TARGET ambrig::library)
  include(CMakeFindDependencyMacro)
  foreach(package Eigen3 tomlplusplus nlohmann_json fmt SUNDIALS Ceres TBB pugixml)
    find_dependency(${package})
  endforeach()
  find_dependency(HDF5 COMPONENTS C)
  find_dependency(PkgConfig)
  foreach(package matio muparser ode libzip nlopt)
    pkg_check_modules(AMBRIG_${package} REQUIRED IMPORTED_TARGET ${package})
  endforeach()
  find_library(AMBRIG_SLICOT slicot REQUIRED)
  add_library(ambrig::library STATIC IMPORTED)
  set_target_properties(ambrig::library PROPERTIES
    IMPORTED_LOCATION "${AMBRIG_PREFIX}/lib/libambrig.a"
    INTERFACE_INCLUDE_DIRECTORIES "${AMBRIG_PREFIX}/include/ambrig"
    INTERFACE_COMPILE_FEATURES cxx_std_20
    INTERFACE_LINK_LIBRARIES "Eigen3::Eigen;fmt::fmt;nlohmann_json::nlohmann_json;tomlplusplus::tomlplusplus;pugixml::pugixml;ceres;TBB::tbb;hdf5::hdf5;SUNDIALS::cvode;SUNDIALS::arkode;SUNDIALS::kinsol;SUNDIALS::nvecserial;PkgConfig::AMBRIG_matio;PkgConfig::AMBRIG_muparser;PkgConfig::AMBRIG_ode;PkgConfig::AMBRIG_libzip;PkgConfig::AMBRIG_nlopt;${AMBRIG_SLICOT}")
endif()
set(ambrig_library_FOUND ${ambrig_FOUND})

# cmake --install, and `cpack` for a Debian package: program, C++ library with its headers, Python module, header and host of
# controllers in C, examples and scenarios, manual pages, completions, find_package(ambrig).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
install(TARGETS ambrig RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET ambrig_fmu_library)
  install(TARGETS ambrig_fmu_library LIBRARY DESTINATION lib/ambrig)  # goes into FMUs
endif()
# The C++ library: the objects of all folders below the program in one archive, and their headers (packaging/ambrigConfig.cmake).
set(library_folders ${AMBRIG_FOLDERS})
list(REMOVE_ITEM library_folders ambrig_workbench)
set(library_objects "")
foreach(folder IN LISTS library_folders)
  list(APPEND library_objects $<TARGET_OBJECTS:${folder}>)
endforeach()
add_library(ambrig_library STATIC ${library_objects})
set_target_properties(ambrig_library PROPERTIES OUTPUT_NAME ambrig LINKER_LANGUAGE CXX)
install(TARGETS ambrig_library ARCHIVE DESTINATION lib)
install(DIRECTORY actuators analysis campaign control core design discovery effects faulttolerance fdd fmu rig rotor scenarios simulation
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ambrig FILES_MATCHING PATTERN "*.h" PATTERN "host" EXCLUDE PATTERN "library" EXCLUDE)
if(TARGET ambrig_python)
  install(TARGETS ambrig_python LIBRARY DESTINATION lib/python3/dist-packages/ambrig)
  install(FILES ${package_sources} DESTINATION lib/python3/dist-packages/ambrig)
endif()
install(FILES control/external/ambrig_controller.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ambrig)
install(DIRECTORY control/external/host DESTINATION ${CMAKE_INSTALL_DATADIR}/ambrig FILES_MATCHING PATTERN "*.[ch]")
install(DIRECTORY schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/ambrig FILES_MATCHING PATTERN "*.json")
install(DIRECTORY scenarios/library scenarios/campaigns DESTINATION ${CMAKE_INSTALL_DATADIR}/ambrig/scenarios
        FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/guide DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md docs/third_party.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ambrigConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES packaging/ambrigConfig.cmake ${CMAKE_BINARY_DIR}/ambrigConfigVersion.cmake DESTINATION lib/cmake/ambrig)
# From the help texts of the program that is installed.
set(pages ${CMAKE_BINARY_DIR}/manual)
install(CODE "execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/packaging/man_pages.py
                              $<TARGET_FILE:ambrig> ${pages} COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${pages}/ambrig.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ambrig)
install(FILES ${pages}/_ambrig DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
add_test(NAME package COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/packaging/check_package.py ${CMAKE_BINARY_DIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ambrig)
set(CPACK_PACKAGE_CONTACT "ambrig <ambrig@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "magnetic-bearing rigs with redundant actuators: simulate, break, compare, explain")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # the libraries that the program is linked with, by their packages
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")  # the Python module
# Controllers in C are compiled by their authors; plots, tables with units; programs with the C++ library.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gcc, python3-matplotlib, python3-xarray, libceres-dev, libeigen3-dev, libfmt-dev, libhdf5-dev, \
libmatio-dev, libmuparser-dev, libnlopt-dev, libode-dev, libpugixml-dev, libslicot-dev, libsundials-dev, libtbb-dev, \
libtomlplusplus-dev, libzip-dev, nlohmann-json3-dev, zlib1g-dev")
include(CPack)

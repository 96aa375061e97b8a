file(GLOB_RECURSE app_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/app/*.cc)
add_executable(ambrig ${app_sources})
target_include_directories(ambrig PRIVATE ${CMAKE_SOURCE_DIR})
target_link_libraries(ambrig PRIVATE ${AMBRIG_FOLDERS} CLI11::CLI11 pugixml::pugixml TBB::tbb)

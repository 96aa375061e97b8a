# The command: a library, so that tests/app can link it, and a main.
file(GLOB_RECURSE app_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/app/*.cc)
list(REMOVE_ITEM app_sources ${CMAKE_SOURCE_DIR}/app/main.cc)
include(cmake/web.cmake)
add_library(ambrig_app STATIC ${app_sources} ${AMBRIG_WEB_ASSETS})
target_include_directories(ambrig_app PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(ambrig_app PUBLIC ${AMBRIG_FOLDERS} CLI11::CLI11 pugixml::pugixml TBB::tbb)
add_executable(ambrig ${CMAKE_SOURCE_DIR}/app/main.cc)
target_link_libraries(ambrig PRIVATE ambrig_app)

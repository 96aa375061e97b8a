# The page of the workbench and its scripts, put into the binary by an assembler file (.incbin) and
# listed in a generated source: workbench/page_files.h knows them by name.
set(page_folder ${CMAKE_SOURCE_DIR}/web/workbench)
file(GLOB page_sources CONFIGURE_DEPENDS ${page_folder}/*.js ${page_folder}/*.css ${page_folder}/*.html)
set(page_assets "")
foreach(file IN LISTS page_sources)
  get_filename_component(name ${file} NAME)
  list(APPEND page_assets "${name}|${file}")
endforeach()
list(APPEND page_assets "lit-html.js|${CMAKE_SOURCE_DIR}/web/node_modules/lit-html/lit-html.js"
     "uplot.js|${CMAKE_SOURCE_DIR}/web/node_modules/uplot/dist/uPlot.iife.min.js"
     "uplot.css|${CMAKE_SOURCE_DIR}/web/node_modules/uplot/dist/uPlot.min.css")
set(assembly "/* Made by cmake/workbench_page.cmake. */\n    .section .rodata\n")
set(externs "")
set(rows "")
set(page_depends "")
set(index 0)
foreach(asset IN LISTS page_assets)
  string(REPLACE "|" ";" asset ${asset})
  list(GET asset 0 name)
  list(GET asset 1 file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "A library of the workbench is missing (${file}): run tools/setup.sh")
  endif()
  set(type "text/javascript; charset=utf-8")
  if(name MATCHES "\\.css$")
    set(type "text/css; charset=utf-8")
  elseif(name MATCHES "\\.html$")
    set(type "text/html; charset=utf-8")
  endif()
  set(symbol ambrig_page_${index})
  string(APPEND assembly "    .global ${symbol}_begin, ${symbol}_end\n"
                         "${symbol}_begin:\n    .incbin \"${file}\"\n${symbol}_end:\n    .byte 0\n")
  string(APPEND externs "extern const char ${symbol}_begin[], ${symbol}_end[];\n")
  string(APPEND rows "    {\"${name}\", \"${type}\", {${symbol}_begin, static_cast<std::size_t>(${symbol}_end - ${symbol}_begin)}},\n")
  list(APPEND page_depends ${file})
  math(EXPR index "${index} + 1")
endforeach()
string(APPEND assembly "    .section .note.GNU-stack,\"\",%progbits\n")
set(AMBRIG_PAGE_ASSEMBLY ${CMAKE_BINARY_DIR}/workbench_page.S)
set(AMBRIG_PAGE_LIST ${CMAKE_BINARY_DIR}/workbench_page_list.cc)
file(CONFIGURE OUTPUT ${AMBRIG_PAGE_ASSEMBLY} CONTENT "${assembly}" @ONLY)
file(CONFIGURE OUTPUT ${AMBRIG_PAGE_LIST} CONTENT
"// Made by cmake/workbench_page.cmake.
#include <cstddef>
#include \"workbench/page_files.h\"
extern \"C\" {
${externs}}
namespace ambrig::workbench {
std::span<const PageFile> PageFiles() {
  static const PageFile files[] = {
${rows}  };
  return files;
}
}  // namespace ambrig::workbench
" @ONLY)
set_source_files_properties(${AMBRIG_PAGE_ASSEMBLY} PROPERTIES OBJECT_DEPENDS "${page_depends}")
target_sources(ambrig_workbench PRIVATE ${AMBRIG_PAGE_ASSEMBLY} ${AMBRIG_PAGE_LIST})

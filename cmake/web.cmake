# What every HTML report carries inside it: the plotting library and our style and script, put into
# the binary by an assembler file (.incbin), so that `ambrig` needs no files beside it.
# AMBRIG_WEB_ASSETS is that file; app/pages/assets.cc knows its symbols.
enable_language(ASM)
set(web ${CMAKE_SOURCE_DIR}/web)
set(plotly ${web}/node_modules/plotly.js-cartesian-dist-min/plotly-cartesian.min.js)
if(NOT EXISTS ${plotly})
  message(FATAL_ERROR "The plotting library of the reports is missing (${plotly}): run tools/setup.sh")
endif()
set(AMBRIG_WEB_ASSETS ${CMAKE_BINARY_DIR}/web_assets.S)
set(text "/* Made by cmake/web.cmake. */\n    .section .rodata\n")
set(files "")
foreach(asset "plotly_js|${plotly}" "report_css|${web}/report.css" "report_js|${web}/report.js")
  string(REPLACE "|" ";" asset ${asset})
  list(GET asset 0 name)
  list(GET asset 1 file)
  string(APPEND text "    .global ambrig_${name}_begin, ambrig_${name}_end\n"
                     "ambrig_${name}_begin:\n    .incbin \"${file}\"\nambrig_${name}_end:\n    .byte 0\n")
  list(APPEND files ${file})
endforeach()
string(APPEND text "    .section .note.GNU-stack,\"\",%progbits\n")
file(CONFIGURE OUTPUT ${AMBRIG_WEB_ASSETS} CONTENT "${text}" @ONLY)
set_source_files_properties(${AMBRIG_WEB_ASSETS} PROPERTIES OBJECT_DEPENDS "${files}")

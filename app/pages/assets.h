#pragma once
/// What a report carries inside it, read from the binary itself (cmake/web.cmake).
#include <string_view>

namespace ambrig {

std::string_view PlotlyJs();   // plotly.js, cartesian bundle, minified (MIT)
std::string_view ReportCss();  // web/report.css
std::string_view ReportJs();   // web/report.js

}  // namespace ambrig

#include "app/pages/assets.h"

#include <cstddef>

extern "C" {
extern const char ambrig_plotly_js_begin[], ambrig_plotly_js_end[];
extern const char ambrig_report_css_begin[], ambrig_report_css_end[];
extern const char ambrig_report_js_begin[], ambrig_report_js_end[];
}

namespace ambrig {
namespace {
std::string_view Between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}
}  // namespace

std::string_view PlotlyJs() { return Between(ambrig_plotly_js_begin, ambrig_plotly_js_end); }
std::string_view ReportCss() { return Between(ambrig_report_css_begin, ambrig_report_css_end); }
std::string_view ReportJs() { return Between(ambrig_report_js_begin, ambrig_report_js_end); }

}  // namespace ambrig

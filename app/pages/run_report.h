#pragma once
/// The report of one run: what happened, and the pictures that show it. Plain data in, one HTML
/// file out.
#include <filesystem>

#include "app/figures/run_data.h"
#include "app/pages/html.h"

namespace ambrig {

HtmlReport MakeRunReport(const RunReportData& data);
/// @throws InputError when the file cannot be written.
void WriteRunReport(const RunReportData& data, const std::filesystem::path& path);

}  // namespace ambrig

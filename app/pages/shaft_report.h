#pragma once
/// The page of `ambrig analyze` of a shaft without magnetic bearings.
#include <filesystem>

#include "analysis/shaft/shaft_analysis.h"

namespace ambrig {

/// One HTML file. @throws InputError when it cannot be written.
void WriteShaftReport(const ShaftAnalysis& analysis, const std::string& file,
                      const std::filesystem::path& path);

}  // namespace ambrig

#pragma once
/// The page of `ambrig analyze`.
#include <filesystem>

#include "analysis/rig_analysis.h"

namespace ambrig {

/// One HTML file. @throws InputError when it cannot be written.
void WriteAnalysisReport(const RigAnalysis& analysis, const std::string& rig_file,
                         const std::filesystem::path& path);

}  // namespace ambrig

#pragma once
/// The report of `ambrig refine`: the law with its band, where it is supported, and what it
/// changed.
#include <string>

#include "discovery/refine/refine.h"

namespace ambrig {

/// Where the curve is supported, or that it is nowhere.
std::string SupportText(const Refinement& r);

void WriteRefineReport(const Refinement& r, const std::string& rig, const std::string& path);

}  // namespace ambrig

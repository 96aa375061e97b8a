#pragma once
/// The paper of the slope detector beside the simulation, as text, JSON and one page with its
/// figures.
#include <nlohmann/json.hpp>
#include <string>

#include "simulation/paper_bench/paper_study.h"

namespace ambrig {

/// At most 80 columns.
std::string PaperText(const PaperStudy& study);
nlohmann::ordered_json PaperJson(const PaperStudy& study);
/// @throws InputError when it cannot be written.
void WritePaperReport(const PaperStudy& study, const std::string& path);

}  // namespace ambrig

#pragma once
/// A JSON file in memory.
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig {

/// @throws InputError "FILE:LINE:COLUMN: not valid JSON", or why the file cannot be read.
nlohmann::json ReadJson(const std::string& file);

}  // namespace ambrig
